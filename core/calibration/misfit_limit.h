#pragma once

#include <algorithm>
#include <vector>

namespace foresight {

/// Of the rms of images; 0 where there is none.
inline double MedianRms(std::vector<double> rms_px) {
  if (rms_px.empty()) return 0.0;
  const auto middle = rms_px.begin() + static_cast<std::ptrdiff_t>(rms_px.size() / 2);
  std::nth_element(rms_px.begin(), middle, rms_px.end());
  return *middle;
}

/// An image whose corners are farther off than this, rms, does not show what the others show.
inline double MisfitLimit(double median_rms_px) {
  constexpr double kMostTimesMedian = 8.0, kLeast_px = 3.0;
  return std::max(kMostTimesMedian * median_rms_px, kLeast_px);
}

}  // namespace foresight
