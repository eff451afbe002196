#pragma once

#include "core/fitting/ray_set.h"

namespace foresight {

/// What EstimateRangeSigma can return.
inline constexpr double kLeastRangeSigma_m = 0.003;
inline constexpr double kLargestRangeSigma_m = 0.035;

/// Standard deviation of the rays' own range noise: from the second differences of three
/// neighbouring ranges along a scan line, which no plane or gentle bend adds to. Those across an
/// edge are left out, so up to half of the region may be edges. The samples behind a dense map are
/// several pixels apart, and so are the three ranges there. Of rays without a grid the
/// neighbours are the nearest two on opposite sides. NaN where fewer than 40 rays
/// have such neighbours. Between 3 and 35 mm. O(n log n); without a grid O(400 n).
double EstimateRangeSigma(const RaySet& rays);

}  // namespace foresight
