#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/random.h"

namespace foresight {

/// A circle that may be a wheel's rim, in base.
struct RimHypothesis {
  Eigen::Vector3d center;
  Eigen::Vector3d axis;  ///< length 1, on the side of RimSearchOptions::facing
  double radius_m = 0.0;
  double score = 0.0;
};

struct RimSearchOptions {
  Eigen::Vector3d facing = Eigen::Vector3d::UnitZ();  ///< where the axis should point, length 1
  double max_tilt_rad = 0.70;                         ///< of the axis from `facing`, 40 deg
  double min_radius_m = 0.045;
  double max_radius_m = 0.240;
  double tolerance_m = 0.030;  ///< a point further from the circle does not support it
  int trials = 6000;
  int keep = 5;
};

/// Circles through three random points, the best few that differ from each other, best first. Half
/// of them are forced to the axis `facing`: three points on noisy ranges tell a radius well but an
/// axis badly. O(trials * points).
std::vector<RimHypothesis> FindRims(std::span<const Eigen::Vector3d> points,
                                    const RimSearchOptions& options, Random& random);

}  // namespace foresight
