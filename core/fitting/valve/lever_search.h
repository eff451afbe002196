#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

struct LeverSearchOptions {
  Eigen::Vector3d facing = Eigen::Vector3d::UnitZ();  ///< where the axis should point, length 1
  double tolerance_m = 0.030;                         ///< a point further from a bar is not on it
  double max_gap_m = 0.040;                           ///< along a bar between neighbouring points
  int trials = 600;                                   ///< bars through two points
  int keep = 3;
};

/// Straight bars among points in base, each as a lever with its pivot at one end and at the other;
/// the best bars first. The ends are rough: a refinement has to follow. O(trials * points).
std::vector<ValveCandidate> FindLevers(const std::vector<Eigen::Vector3d>& points,
                                       const LeverSearchOptions& options, Random& random);

}  // namespace foresight
