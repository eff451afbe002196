#pragma once

#include <algorithm>
#include <vector>

#include "core/base/quantile.h"

namespace foresight {

/// Of the rms of images; 0 where there is none.
inline double MedianRms(std::vector<double> rms_px) {
  return rms_px.empty() ? 0.0 : UpperMedian(std::move(rms_px));
}

/// An image whose corners are farther off than this, rms, does not show what the others show.
inline double MisfitLimit(double median_rms_px) {
  constexpr double kMostTimesMedian = 8.0, kLeast_px = 3.0;
  return std::max(kMostTimesMedian * median_rms_px, kLeast_px);
}

}  // namespace foresight
