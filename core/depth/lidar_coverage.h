#pragma once

#include "core/depth/aligned_samples.h"

namespace foresight {

/// Where the lidar has looked: 1 within two spacings of a kept sample (the larger of those along
/// and between the lines), 0 elsewhere; of the size of the samples' image. For methods that fill
/// every pixel and know no confidence: what lies outside is made up. Fails with kTooFewPoints where
/// no spacing can be measured. O(pixels).
FloatImage LidarCoverage(const AlignedSamples& samples);

}  // namespace foresight
