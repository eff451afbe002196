#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include "core/simulation/scene.h"
#include "core/simulation/shapes.h"

namespace foresight {

/// A mesh of one material that stands on a table: shapes are added in the frame of a place there (x
/// as one likes, z = up).
class TableThing {
 public:
  TableThing(std::string name, const Rigid<frame::Robot, frame::Object>& robot_from_place,
             const Material& material);

  void Add(const Shape& shape, const Rigid<frame::Object, frame::Object>& place_from_shape);
  /// A box about its middle, turned about z.
  void AddBox(const Eigen::Vector3d& size_m, const Eigen::Vector3d& middle_m, double yaw_rad = 0.0);
  void AddCylinder(double radius_m, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m);
  /// An outline (radius, how far along) turned about the line from one point towards another, wider
  /// or narrower across by `flattened`: across the line and level.
  void AddRevolved(std::span<const Eigen::Vector2d> outline, const Eigen::Vector3d& from_m,
                   const Eigen::Vector3d& towards_m, double flattened = 1.0);
  void AddRevolved(std::initializer_list<Eigen::Vector2d> outline, const Eigen::Vector3d& from_m,
                   const Eigen::Vector3d& towards_m, double flattened = 1.0);
  /// An ellipse (half along x, half along y) swept along a path that is nearly upright.
  void AddGrip(const Eigen::Vector2d& half_m, std::span<const Eigen::Vector3d> path);

  void MoveTo(Scene& scene);

 private:
  SceneMesh mesh_;
};

}  // namespace foresight
