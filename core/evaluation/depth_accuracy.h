#pragma once

#include <cstdint>
#include <vector>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// How good a depth map is, Section V-A. Percentiles are of |depth - truth| over the pixels that
/// have a truth and that the mask keeps.
struct DepthAccuracy {
  double a80_mm = 0.0;  ///< NaN when no pixel is scored
  double a95_mm = 0.0;
  double coverage = 0.0;       ///< kept fraction of the pixels with a truth
  double unscored_kept = 0.0;  ///< kept fraction of the pixels without one: invented depth
  std::int64_t scored = 0;     ///< pixels the percentiles are of
};

/// @param mask 255 = kept; @param truth_m NaN = unknown; @param stride scores every stride-th row
/// and column. Fails with kInvalidInput when the sizes differ. A kept pixel without a depth counts
/// as not kept.
Result<DepthAccuracy> ScoreDepth(const DepthImage& depth_m, const MaskImage& mask,
                                 const DepthImage& truth_m, int stride);

/// The p-th percentile, 0 <= p <= 100, of the values: that at rank ceil(p/100 n).
double Percentile(std::vector<double> values, double p);

}  // namespace foresight
