#pragma once

#include "core/base/image.h"
#include "core/depth/aligned_samples.h"

namespace foresight {

/// The kept samples as an image, for methods that fit a whole depth map to them. A sample counts
/// for the pixel nearest to it.
struct SampleImage {
  DepthImage mean_m;  ///< of the pixel's samples; 0 without
  FloatImage count;   ///< how many there are
  float nearest_m = 0.0f;
  float farthest_m = 0.0f;
};

/// Fails with kInvalidInput when the guide has another size than the samples' image, kTooFewPoints
/// when no sample is kept.
Result<SampleImage> AverageByPixel(const AlignedSamples& samples, const ColorImage& guide);

/// A depth for every pixel that ignores the image, where iterative methods start: pixels with
/// samples keep their mean, others take theirs from ever coarser averages. O(pixels).
DepthImage FillSmoothly(const SampleImage& samples);

}  // namespace foresight
