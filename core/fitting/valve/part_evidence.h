#pragma once

#include <vector>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// From a spoke to where a further one is looked for, up to the next spoke, radians. Nearer to a
/// spoke its own sides look like one. Of a wheel with spokes.
std::vector<double> TurnsToFurtherSpokes(const ValveModel& model);

/// What the measured rays say of a valve's rim, of each of its spokes and of spokes that it has
/// not: ValveEvidence::rim_nats, weakest_arc_nats, weakest_quarter_nats, weakest_spoke_nats,
/// weakest_spoke_middle_nats and further_spoke_nats.
void AddEvidenceOfParts(const BeamLikelihood& likelihood, const ValveCandidate& valve,
                        ValveEvidence& evidence);

}  // namespace foresight
