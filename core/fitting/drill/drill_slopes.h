#pragma once

#include <Eigen/Core>

#include "core/fitting/drill/drill_state.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// What the rays know of a drill's parameters.
struct DrillSlopes {
  /// If each ray is an independent measurement of the template: the inverse of their covariance,
  /// the prior included.
  DrillInformation information = DrillInformation::Zero();
  /// (rays x parameters): which way each ray pulls, its error times its slopes. Without the prior.
  Eigen::MatrixXd scores;
};

/// By differences of 1 mm or 1 mrad. A ray that grazes an outline knows where that is, one further
/// in how far the surface is; one that neither hits nor grazes the drill, or whose range disagrees
/// with it, knows nothing. O(rays x parameters).
DrillSlopes SlopesOf(const RaySet& rays, const DrillState& drill, const TableFrame& base_from_table,
                     const DrillPrior& prior);

}  // namespace foresight
