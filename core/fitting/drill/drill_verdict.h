#pragma once

#include <string>
#include <vector>

#include "core/fitting/drill/drill_state.h"
#include "core/fitting/drill/fit_drill.h"
#include "core/fitting/drill/solid_likelihood.h"

namespace foresight {

/// Counts what the rays of a region say about a drill; the likelihoods are left at 0.
DrillEvidence GatherEvidence(const RaySet& rays, const DrillCandidate& drill);

/// What the rays know of a drill's parameters: the inverse of their covariance, the prior included.
DrillInformation InformationOf(const RaySet& rays, const DrillState& drill,
                               const TableFrame& base_from_table, const DrillPrior& prior);

/// Standard deviations and covariance of the detection.
void SetSigmas(const DrillInformation& information, const DrillState& drill,
               DrillDetection& detection);

/// What Verdict::features holds, in its order.
std::vector<std::string> DrillFeatureNames();

/// How far an operator may trust a detection whose evidence, sigmas and candidates are filled in.
/// The probability is the shipped model's (resources/verdicts/drill_raw and _dense); hard gates
/// keep what no probability should: a confirmed drill stands on a table near the region's centre,
/// has enough measurements on it, is not seen through, shows its head, explains the rays better
/// than a box and a cylinder, lies within the region, has no second direction close behind and no
/// parameter at a bound. `rays` are those of the `region` that it was fitted to.
Verdict AssessDrill(const RaySet& rays, const RaySet& region, const DrillDetection& detection,
                    const DrillState& drill, const DrillPrior& prior);

}  // namespace foresight
