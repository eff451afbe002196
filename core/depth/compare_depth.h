#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/base/image.h"

namespace foresight {

/// How two masked depth maps of one image differ. Only pixels that both keep have a difference.
struct DepthComparison {
  static constexpr double kFullScale_m = 0.030;  ///< of histogram and picture, to either side
  static constexpr std::size_t kBins = 60;       ///< of 1 mm

  std::int64_t in_both = 0;         ///< pixels that both keep
  std::int64_t only_in_first = 0;   ///< that the second masks, or has no depth at
  std::int64_t only_in_second = 0;  ///< the reverse
  std::int64_t in_neither = 0;
  // Of |second - first| in pixels of both; NaN where there is none.
  double median_abs_m = std::numeric_limits<double>::quiet_NaN();
  double p95_abs_m = std::numeric_limits<double>::quiet_NaN();
  double max_abs_m = std::numeric_limits<double>::quiet_NaN();
  /// Mean of second - first: positive where the second lies further away.
  double mean_m = std::numeric_limits<double>::quiet_NaN();
  /// Pixels by second - first, from -kFullScale_m on; what is beyond either end is counted apart.
  std::array<std::int64_t, kBins> histogram = {};
  std::int64_t below_histogram = 0;
  std::int64_t above_histogram = 0;
  DepthImage difference_m;  ///< second - first; NaN where not both keep the pixel
};

/// Compares pixel by pixel. A mask of 0 hides a pixel. All images have one size. O(pixels).
DepthComparison CompareDepth(const DepthImage& first_m, const MaskImage& first_mask,
                             const DepthImage& second_m, const MaskImage& second_mask);

}  // namespace foresight
