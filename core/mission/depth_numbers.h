#pragma once

#include <string>

#include "core/depth/upsample.h"
#include "core/mission/mission_records.h"

namespace foresight {

/// What a DepthRecord keeps of a depth map. Two maps with the same digest are equal in every bit of
/// depth, confidence and mask (whatever the bits of a NaN are).
std::string DigestOf(const DenseDepth& dense, const MaskImage& mask);

/// `mask` has the size of the depth map; 0 hides a pixel.
DepthStatistics StatisticsOf(const DenseDepth& dense, const MaskImage& mask);

}  // namespace foresight
