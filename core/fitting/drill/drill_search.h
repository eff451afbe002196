#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fitting/beam_likelihood.h"
#include "core/fitting/drill/drill_state.h"

namespace foresight {

/// Where on the table something as thick as a grip stands upright: the middle of a circle behind
/// each of the points that faces the viewer, kept where the rays agree with a cylinder there. At
/// the noise of a lidar normals are useless for this. The best few, at least 25 mm apart.
std::vector<Eigen::Vector2d> FindBodies(const BeamLikelihood& likelihood,
                                        const std::vector<Eigen::Vector3d>& foreground,
                                        const TableFrame& base_from_table, double radius_m);

/// Every direction and size of each template at each body, scored by ray; the leading local maxima,
/// best first, none near a better one of its template. Fails with kCancelled.
Result<std::vector<DrillState>> FindModes(const BeamLikelihood& likelihood,
                                          std::span<const DrillTemplate> templates,
                                          const std::vector<Eigen::Vector2d>& bodies,
                                          const TableFrame& base_from_table,
                                          const DrillPrior& prior, const RunContext& context);

/// Another template where a drill stands, the way that it points, in the size that explains the
/// rays best, its proportions those of the template.
DrillState OfKind(const BeamLikelihood& likelihood, const DrillTemplate& kind,
                  const DrillState& state, const TableFrame& base_from_table,
                  const DrillPrior& prior);

enum class LocalSearchEffort {
  kCoarse,  ///< some parameters, to 2.5 mm
  kFine,    ///< all, and along what the rays know least in the end
};

/// Climbs the likelihood over all parameters of a drill, the bit's length by trying lengths first.
/// The result's log_likelihood is never below the start's under the same likelihood.
DrillState LocalSearch(const BeamLikelihood& likelihood, const DrillState& start,
                       const TableFrame& base_from_table, const DrillPrior& prior,
                       LocalSearchEffort effort);

/// Log likelihood with the prior.
double Score(const BeamLikelihood& likelihood, const DrillState& state,
             const TableFrame& base_from_table, const DrillPrior& prior);

}  // namespace foresight
