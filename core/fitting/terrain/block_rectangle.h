#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/terrain/surface_planes.h"

namespace foresight {

/// What the rays say about a plane and the space around its points. Coordinates are of a frame in
/// the plane: where a ray intersects it is known much better than where its return lies.
struct PlaneView {
  struct Sample {
    Eigen::Vector2d at;    ///< where the ray intersects the plane
    double area_m2 = 0.0;  ///< that it stands for, on the plane
    int point = -1;        ///< of the grid
  };

  SurfacePlane surface;
  Eigen::Vector3d x, y;         ///< the frame's axes, in base; its origin is surface.center
  std::vector<Sample> support;  ///< the plane's own points
  std::vector<Sample> through;  ///< rays that went on behind the plane
  /// Returns of other surfaces within 50 mm above the plane, beside or inside what would be a block
  /// there; `at` is the foot of their perpendicular on the plane. What is higher is left out.
  std::vector<Sample> occupied;

  Eigen::Vector2d Flat(const Eigen::Vector3d& point) const {
    return {x.dot(point - surface.center), y.dot(point - surface.center)};
  }
  Eigen::Vector3d InBase(const Eigen::Vector2d& at) const {
    return surface.center + at.x() * x + at.y() * y;
  }
};

/// Rays that intersect a plane within `margin_m` of its points' bounds.
PlaneView ViewOfPlane(const SurfaceGrid& grid, const SurfacePlanes& surfaces, int plane,
                      double margin_m);

/// A rectangle on a plane, in the frame of its PlaneView.
struct BlockRectangle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;  ///< from the frame's x to the side of size.x()
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  double score_m2 = 0.0;

  /// A point in the rectangle's own frame.
  Eigen::Vector2d Local(const Eigen::Vector2d& at) const;
  Eigen::Vector2d Flat(const Eigen::Vector2d& local) const;
  /// How far inside a point lies; negative outside.
  double Inside(const Eigen::Vector2d& at) const;
};

/// How far around a rectangle support speaks against it, and how much against what lies inside.
inline constexpr double kRectangleBand_m = 0.120;
inline constexpr double kOutsideWeight = 0.7;

/// The smallest rectangle around most of the support (the outermost 1 % on each side left out).
BlockRectangle BoundsOfSupport(const PlaneView& view);

/// The rectangles of a known size that explain a plane best: each maximises S - V - 0.7 O, where S
/// is the support's area inside, V the area inside that rays went through or that other things
/// occupy, O the support's area in a band around it. Blocks side by side are peeled off one by one,
/// from the corners of their patch. Rectangles with less than `min_cover` of support are not
/// offered.
std::vector<BlockRectangle> FitRectangles(const PlaneView& view, const Eigen::Vector2d& size_m,
                                          double min_cover, double softness_m);

}  // namespace foresight
