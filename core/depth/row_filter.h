#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/depth/filter_window.h"

namespace foresight {

/// Which passes Eq. (9) sums over, for n passes after D0.
enum class ConfidencePasses {
  kAll,         ///< G of the first pass, where H is omitted, and G H(D^0) .. G H(D^(n-1))
  kEveryDepth,  ///< G H(D^0) .. G H(D^n): one pass more, for the confidence alone
  kGuided,      ///< G H(D^0) .. G H(D^(n-1))
};

/// The filter of Eq. (8) and (9) over a block of rows, in the widest registers that the processor
/// has: neighbouring pixels side by side. Several threads may filter different rows at once.
struct JointFilter {
  const SparseDepthMap& samples;
  const SpatialKernel& spatial;
  const GrayImage& guide;                   ///< I, of the samples' size
  std::span<const float> sample_intensity;  ///< samples.ValuesAt(guide)
  float sigma_intensity = 20.0f;
  float sigma_depth_m = 0.030f;
  int iterations = 5;               ///< passes after D0
  bool literal_weights = false;     ///< exp(G + K + H) instead of G K H
  bool literal_confidence = false;  ///< exp(G + H) instead of G H
  ConfidencePasses confidence = ConfidencePasses::kAll;
};

/// Images of the guide's size; only the filtered rows are written.
struct JointFilterOutput {
  DepthImage& depth_m;               ///< NaN where D0 has no support
  FloatImage& confidence;            ///< 0 there
  std::span<DepthImage> iterations;  ///< D0 .. Dn, or empty
};

/// What Fig. 6(b) is made of.
struct FilterChange {
  std::span<double> sum_m;  ///< sum of |D(t+1) - D(t)|, one a pass after D0; is added to
  std::int64_t pixels = 0;  ///< that have a depth; is added to
};

/// Filters the rows top <= y < bottom. O(pixels * samples in Omega * passes).
void FilterRows(const JointFilter& filter, int top, int bottom, const JointFilterOutput& output,
                FilterChange& change);

}  // namespace foresight
