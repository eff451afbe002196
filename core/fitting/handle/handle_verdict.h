#pragma once

#include <string>
#include <vector>

#include "core/fitting/handle/handle_state.h"

namespace foresight {

/// Counts what the rays say about a handle; the likelihoods are left at 0.
HandleEvidence GatherEvidence(const BeamLikelihood& likelihood, const Plane& door,
                              const HandleCandidate& handle);

/// Standard deviations and covariance of the detection: from how what the beams should read changes
/// with the handle, the beams of a scan line erring together (CovarianceClusteredByLine), the
/// door's normal from the rays that end on it, and what no beam tells, chosen on training scenes
/// (docs/evaluation.md, "Door handle fit").
void SetSigmas(const HandleScorer& scorer, const HandleState& handle, HandleDetection& detection);

/// What Verdict::features holds, in its order.
std::vector<std::string> HandleFeatureNames();

/// How far an operator may trust a detection whose evidence, sigmas and candidates are filled in.
/// The probability is the shipped model's (resources/verdicts/handle_*); hard gates keep what no
/// probability should: a confirmed handle has enough measurements on it, is not seen through, does
/// not as well point the other way, explains the rays better than a knob, a pull bar, a bow and a
/// box, lies near the region's centre and has no length at a bound. Without a model, as before its
/// first weights, the probability is NaN and the verdict LIKELY at most, where no gate failed.
/// `region` = the rays that it was looked for in.
Verdict AssessHandle(const RaySet& region, const HandleDetection& detection,
                     const FitHandleOptions& options);

}  // namespace foresight
