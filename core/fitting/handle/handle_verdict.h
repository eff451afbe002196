#pragma once

#include <string>
#include <vector>

#include "core/fitting/handle/handle_state.h"

namespace foresight {

/// Counts what was measured says about a handle, the beams behind a map where they are known; the
/// likelihoods are left at 0.
HandleEvidence GatherEvidence(const BeamLikelihood& likelihood, const Plane& door,
                              const HandleCandidate& handle);

/// Standard deviations and covariance of the detection: from how what the beams should read changes
/// with the handle, the beams of a scan line erring together (CovarianceClusteredByLine), the
/// door's normal from the rays that end on it, and what no beam tells, chosen on training scenes
/// (docs/evaluation/handle.md, "Door handle fit").
void SetSigmas(const HandleScorer& scorer, const HandleState& handle, HandleDetection& detection);

/// What Verdict::features holds, in its order.
std::vector<std::string> HandleFeatureNames();

/// How far an operator may trust a detection whose evidence, sigmas and candidates are filled in.
/// The probability is the shipped model's (resources/verdicts/handle_*); the verdict is LIKELY at
/// most, as too many of the answers that would have been CONFIRMED were wrong, and UNSURE where a
/// lever that points the other way is less than 2 : 1 or another thing less than 150 : 1 behind.
/// Gates say what else speaks against it: few measurements on it, beams that went through it, a
/// lever that points the other way or one of HandleAlternative that explains the rays as well, a
/// place far from the region's centre, a length at a bound, a bar over 195 mm. Without a model, as
/// before the first weights, the probability is NaN and what fails a gate UNSURE.
/// @param region the rays that it was looked for in
/// @param proportions_nats log of the prior's density: how usual a handle of this build is
Verdict AssessHandle(const RaySet& region, const HandleDetection& detection,
                     const FitHandleOptions& options, double proportions_nats);

}  // namespace foresight
