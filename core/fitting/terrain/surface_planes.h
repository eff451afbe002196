#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/terrain/surface_grid.h"
#include "core/geometry/plane.h"

namespace foresight {

/// A plane and what it is known from.
struct SurfacePlane {
  Plane plane;                                       ///< its normal towards the viewer
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of its points
  int points = 0;
  double area_m2 = 0.0;  ///< that its points cover
  double rms_m = 0.0;    ///< of its points from it, outliers left out
};

/// Which plane each point of a grid belongs to.
struct SurfacePlanes {
  std::vector<SurfacePlane> planes;
  std::vector<int> labels;  ///< index into planes; -1 = none
};

/// The points that bear each plane's label, in the grid's order.
std::vector<std::vector<int>> PointsOfEach(const SurfacePlanes& surfaces);

/// Standard deviation of a point's distance from a plane, from that of its range and what a
/// surface is rough by.
double DistanceSigma(const SurfaceGrid& grid, int i, const Plane& plane);

/// Area of a plane that a point's ray stands for which intersects it at `range_m`: of a point
/// behind the plane that is not the point's own range.
double AreaOn(const Plane& plane, const GridPoint& point, double range_m);

/// How far a small angle in the plane of sight and normal reaches on a plane, intersected at
/// `range_m` by a ray along `direction` (length 1); ten times its width at most.
double LengthOn(const Plane& plane, const Eigen::Vector3d& direction, double range_m,
                double angle_rad);

/// Fits every plane again to the points that bear its label (robust least squares of ranges), and
/// drops those that cover less than `min_area_m2`: their points belong to none.
void RefitPlanes(const SurfaceGrid& grid, double min_area_m2, SurfacePlanes& surfaces);

}  // namespace foresight
