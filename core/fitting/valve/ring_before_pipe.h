#pragma once

#include <optional>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// How much better a wheel of two spokes explains the rays than its rim and hub before a straight
/// pipe that goes on beyond the rim, at the place that suits the pipe best:
/// ValveEvidence::pipe_margin_nats. A pipe lies behind the rim. nullopt for all other valves: no
/// single pipe looks like their spokes. About 200 likelihoods.
std::optional<double> MarginOverPipe(const BeamLikelihood& likelihood, const ValveCandidate& valve);

}  // namespace foresight
