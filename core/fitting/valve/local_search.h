#pragma once

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// Climbs the ray likelihood by a shrinking pattern search over all parameters; it is not smooth
/// enough for derivatives. `start` must carry its own log_likelihood; the result's is never lower.
ValveCandidate LocalSearch(const BeamLikelihood& likelihood, const ValveCandidate& start);

}  // namespace foresight
