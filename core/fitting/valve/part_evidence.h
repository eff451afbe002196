#pragma once

#include "core/fitting/valve/ray_likelihood.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// What the measured rays say of a valve's rim, of each of its spokes and of spokes that it has
/// not: ValveEvidence::rim_nats, weakest_spoke_nats, weakest_spoke_middle_nats and
/// further_spoke_nats.
void AddEvidenceOfParts(const RayLikelihood& likelihood, const ValveCandidate& valve,
                        ValveEvidence& evidence);

}  // namespace foresight
