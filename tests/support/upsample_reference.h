#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/depth/upsample.h"

namespace foresight {

/// Eq. (8) and (9) written down as plainly as possible, in double precision, either weights: the
/// truth that the fast filter is held against. Quadratic in everything; for small images only.
inline DenseDepth UpsampleByTheBook(const AlignedSamples& samples, const ColorImage& guide,
                                    const UpsampleOptions& options) {
  const GrayImage intensity = ToGray(guide);
  const double sigma_s = options.sigma_spatial_px;
  const double radius = options.radius_in_sigmas * sigma_s;
  DenseDepth dense;
  dense.depth_m =
      DepthImage(guide.width(), guide.height(), std::numeric_limits<float>::quiet_NaN());
  dense.confidence = FloatImage(guide.width(), guide.height(), 0.0f);
  for (int y = 0; y < guide.height(); ++y)
    for (int x = 0; x < guide.width(); ++x) {
      double depth = 0.0, confidence = 0.0;
      bool any = false;
      const bool every_depth = options.confidence_passes == ConfidencePasses::kEveryDepth;
      for (int t = 0; t <= options.iterations + (every_depth ? 1 : 0); ++t) {
        const bool counts = t > 0 || options.confidence_passes == ConfidencePasses::kAll;
        double weights = 0.0, weighted = 0.0;
        for (std::size_t i = 0; i < samples.samples.size(); ++i) {
          if (samples.reasons[i] != RejectReason::kKept) continue;
          const int qx = static_cast<int>(std::lround(samples.samples[i].u));
          const int qy = static_cast<int>(std::lround(samples.samples[i].v));
          const double distance2 = (qx - x) * (qx - x) + (qy - y) * (qy - y);
          if (distance2 > radius * radius) continue;
          const double difference = intensity(qx, qy) - intensity(x, y);
          const double r = samples.samples[i].depth_m;
          const double g = std::exp(-distance2 / (2 * sigma_s * sigma_s));
          const double k = std::exp(-difference * difference /
                                    (2 * options.sigma_intensity * options.sigma_intensity));
          const double h = t == 0 ? 1.0
                                  : std::exp(-(depth - r) * (depth - r) /
                                             (2 * options.sigma_depth_m * options.sigma_depth_m));
          const bool literal = options.weights == UpsampleOptions::Weights::kLiteral;
          const double without_h = literal && t == 0 ? 0.0 : h;
          const double w = literal ? std::exp(g + k + without_h) : g * k * h;
          weights += w;
          weighted += w * r;
          const bool literal_sum = options.confidence_terms.value_or(options.weights) ==
                                   UpsampleOptions::Weights::kLiteral;
          if (counts) confidence += literal_sum ? std::exp(g + (t == 0 ? 0.0 : h)) : g * h;
        }
        if (t > options.iterations) continue;  // a pass for the confidence alone
        any = any || weights > 1e-30;
        if (weights > 1e-30) depth = weighted / weights;
      }
      if (!any) continue;
      dense.depth_m(x, y) = static_cast<float>(depth);
      dense.confidence(x, y) = static_cast<float>(confidence);
    }
  for (const float c : dense.confidence.values())
    dense.max_confidence = std::max(dense.max_confidence, c);
  return dense;
}

}  // namespace foresight
