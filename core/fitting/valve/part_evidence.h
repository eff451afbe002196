#pragma once

#include "core/fitting/valve/ray_likelihood.h"
#include "core/fitting/valve/valve_detection.h"
#include "core/geometry/angles.h"

namespace foresight {

/// Where further spokes are looked for. Nearer to a spoke its own sides look like one.
inline constexpr double kSpokeStep_rad = RadiansFromDegrees(5.0);
inline constexpr double kBesideSpoke_rad = RadiansFromDegrees(15.0);

/// What the measured rays say of a valve's rim, of each of its spokes and of spokes that it has
/// not: ValveEvidence::rim_nats, weakest_spoke_nats, weakest_spoke_middle_nats and
/// further_spoke_nats.
void AddEvidenceOfParts(const RayLikelihood& likelihood, const ValveCandidate& valve,
                        ValveEvidence& evidence);

}  // namespace foresight
