#include <cmath>
#include <limits>

#include "core/depth/upsample.h"

namespace foresight {

Status ConfidenceMaskOptions::Check() const {
  if (!(threshold >= 0.0 && threshold <= 1.0))
    return Fail(ErrorCode::kInvalidOptions, "confidence mask: threshold {} is not in [0, 1]",
                threshold);
  return {};
}

Result<MaskImage> MaskLowConfidence(const DenseDepth& dense, const ConfidenceMaskOptions& options) {
  FORESIGHT_CHECK(options.Check());
  MaskImage mask(dense.depth_m.width(), dense.depth_m.height(), 0);
  const float reference = options.reference == ConfidenceMaskOptions::Reference::kLargest
                              ? dense.max_confidence
                              : dense.nominal_confidence;
  const auto limit = static_cast<float>(options.threshold * reference);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (!std::isnan(dense.depth_m.values()[i]) && dense.confidence.values()[i] >= limit)
      mask.values()[i] = 255;
  return mask;
}

DepthImage ApplyMask(const DepthImage& depth_m, const MaskImage& mask) {
  FORESIGHT_EXPECTS(depth_m.SameSize(mask), "a mask belongs to one depth map");
  DepthImage masked = depth_m;
  for (std::size_t i = 0; i < masked.size(); ++i)
    if (mask.values()[i] == 0) masked.values()[i] = std::numeric_limits<float>::quiet_NaN();
  return masked;
}

}  // namespace foresight
