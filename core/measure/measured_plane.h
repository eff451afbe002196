#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/geometry/plane.h"

namespace foresight {

/// A plane that was fitted to measured points, in robot.
struct MeasuredPlane {
  Plane plane;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the points that lie in it
  double rms_m = 0.0;                                ///< of their distances
  int inliers = 0;
  int points = 0;         ///< that were tried
  std::string made_from;  ///< "points within 150 mm of the click"
};

struct MeasuredPlaneOptions {
  double radius_m = 0.15;           ///< around a click
  double inlier_distance_m = 0.03;  ///< about three sigma of the lidar
  int min_inliers = 30;
  /// Of the points that must lie in it: else there is no plane that is meant.
  double min_inlier_ratio = 0.5;
};

/// The plane that most of the points lie in, facing `seen_from`. Fails with kTooFewPoints, and with
/// kNoConvergence where less than `min_inlier_ratio` of them agree on one. O(points).
Result<MeasuredPlane> FitMeasuredPlane(std::span<const Eigen::Vector3d> points,
                                       const Eigen::Vector3d& seen_from,
                                       const MeasuredPlaneOptions& options = {});

}  // namespace foresight
