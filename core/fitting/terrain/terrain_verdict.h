#pragma once

#include <string>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/terrain/block_evidence.h"

namespace foresight {

/// What the probability of a block is computed from, in the order of Verdict::features.
std::vector<std::string> TerrainFeatureNames();

/// How far an operator may trust a block whose pose, covariance and evidence are filled in: the
/// probability that its centre is right within 25 mm and its normal within 2.5 deg. Never CONFIRMED
/// with cover below 0.6, a place that is known worse than 10 mm, or support beyond it (it is part
/// of something larger) on more than a tenth of its area, a fifth where lidar returns say so; never
/// LIKELY below 0.90, with fewer than 2 edges, or odds of its size below 4.5 : 1.
Verdict AssessBlock(const RaySet& rays, const TerrainSurface& block,
                    const RectangleEvidence& evidence);

/// Of the whole: the verdict of its worst block that is offered as a foothold; UNSURE without one.
Verdict AssessTerrain(const std::vector<TerrainSurface>& surfaces);

}  // namespace foresight
