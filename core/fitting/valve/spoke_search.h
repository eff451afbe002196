#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fitting/beam_likelihood.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// For each number of spokes (0 = a disc) the best valve on one of the given rims: a grid of dish
/// and phase scored by `coarse`, its best cell refined on the rays of `fine` and scored by it. Best
/// first. Fails with kCancelled.
Result<std::vector<ValveCandidate>> FindSpokes(const BeamLikelihood& coarse,
                                               const BeamLikelihood& fine,
                                               const std::vector<ValveCandidate>& rims,
                                               const std::vector<int>& spoke_counts,
                                               const RunContext& context);

}  // namespace foresight
