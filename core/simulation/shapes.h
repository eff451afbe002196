#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/rigid.h"
#include "core/simulation/scene.h"

namespace foresight {

/// Triangles of one solid in its own frame, metres, wound counter-clockwise seen from outside.
struct Shape {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

/// Centred on the origin.
Shape BoxShape(const Eigen::Vector3d& size_m);
/// A rectangle in z = 0 around the origin.
Shape RectangleShape(double width_m, double height_m);

// Round shapes turn around z and are centred on the origin. 128 corners to a turn: the flats of a
// 0.2 m wheel lie 0.06 mm inside the true surface, far below the noise of any sensor here.
Shape CylinderShape(double radius_m, double length_m);
Shape SphereShape(double radius_m);
Shape TorusShape(double radius_m, double tube_radius_m);
/// Length between the centres of its two half spheres.
Shape CapsuleShape(double radius_m, double length_m);
/// A plate of constant thickness between a hub at z = -dish_m and the circle z = 0, r = radius_m.
Shape DishShape(double radius_m, double dish_m, double thickness_m);

/// Points (radius, z), turned around z. They run upwards on the outside, from below the solid to
/// above it; closed = the last is joined to the first, as of a ring's section.
Shape RevolvedShape(std::span<const Eigen::Vector2d> outline, bool closed);

/// A convex section, counter-clockwise in its own x and y, moved along a path of at least two
/// points. Its y stays as near to `up` as the path allows, which never runs along it; x = y cross
/// the path. `scales` widen it at each point, empty = 1. Its ends are capped.
Shape SweptShape(std::span<const Eigen::Vector2d> section, std::span<const Eigen::Vector3d> path,
                 const Eigen::Vector3d& up, std::span<const double> scales = {});

/// Adds the shape to a mesh.
void AppendShape(const Shape& shape, const Rigid<frame::Robot, frame::Object>& robot_from_shape,
                 SceneMesh& mesh);

/// The pose in the parent's frame of a shape whose z axis runs from one point to another and whose
/// origin is half way. The points differ.
Rigid<frame::Object, frame::Object> PoseAlong(const Eigen::Vector3d& from,
                                              const Eigen::Vector3d& to);

}  // namespace foresight
