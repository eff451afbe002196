#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/fitting/beam_footprints.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_state.h"
#include "core/geometry/plane.h"

namespace foresight {

struct RefineOptions {
  ValveParts parts = ValveParts::kAll;
  bool free_space = true;  ///< rays that went through the template push it away
  int max_rays = 500;      ///< thinned evenly
  int rounds = 4;          ///< of deciding what each ray saw
  int steps = 4;           ///< at most, of Levenberg-Marquardt in a round
};

/// Ceres's Levenberg-Marquardt on all parameters (docs/adr/0026-solvers-of-the-fits.md). A ray
/// whose range agrees with the template pulls its surface along the ray and towards it across; a
/// ray that ended behind the template pushes it aside. The result depends on a start within a few
/// centimetres; its likelihood is not set.
ValveCandidate Refine(const BeamFootprints& footprints, const ValveCandidate& start,
                      const RefineOptions& options);

/// J^T J with robust weights at an answer: the inverse of the covariance of rays that err alone.
ValveInformation InformationAt(const BeamFootprints& footprints, const ValveCandidate& valve,
                               const RefineOptions& options);

/// What each ray says of the parameters at an answer, for its covariance.
struct ValveScores {
  std::vector<RangeRay> rays;  ///< those looked at
  /// (rays x parameters): minus the slopes of a ray's cost, robust weight included.
  Eigen::MatrixXd scores;
  ValveInformation information;  ///< J^T J, the prior's included
  ValveInformation prior;        ///< the prior's alone
};

ValveScores ScoresOf(const BeamFootprints& footprints, const ValveCandidate& valve,
                     const RefineOptions& options);

}  // namespace foresight
