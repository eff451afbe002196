#pragma once

#include "core/depth/upsample.h"

namespace foresight {

/// Park et al., "High quality depth map upsampling for 3D-TOF cameras", ICCV 2011, without their
/// segmentation and saliency. The fraction and sigma_color are not theirs: they were chosen on
/// quarter size Middlebury scenes.
struct NonlocalOptions {
  double smoothness = 0.3;         ///< lambda, of the mean over a pixel's connections
  double nonlocal_fraction = 0.1;  ///< what a similar pixel counts beside a neighbour
  double sigma_color = 5.0;        ///< levels of 8 bits, root mean square over the channels
  int window_radius_px = 5;        ///< similar pixels are looked for in 11 x 11
  int patch_radius_px = 1;         ///< and compared by 3 x 3
  int similar_pixels = 8;          ///< so many of them are connected to each pixel
  int iterations = 200;            ///< conjugate gradient steps at most

  Status Check() const;
};

/// The depth d that minimises
///   sum_samples (d - R)^2 + lambda / (8 + similar_pixels) sum_pq w_pq (d_p - d_q)^2,
/// pq over the 8 neighbours of each pixel and over the pixels nearby whose neighbourhoods look most
/// like its own; w_pq = exp(-|I_p - I_q|^2 / (2 sigma^2)) of the colours of neighbours, and
/// nonlocal_fraction times that of the patches of similar pixels. Conjugate gradients from a smooth
/// fill. Every pixel gets a depth, however far from a sample; the method does not know how good it
/// is: confidence and max_confidence are 1. Fails with kInvalidInput when the guide has another
/// size than the samples' image, kTooFewPoints when no sample is kept, kCancelled.
/// O(pixels * (window * patch side + iterations * similar pixels)); about 400 bytes a pixel.
Result<DenseDepth> UpsampleNonlocal(const AlignedSamples& samples, const ColorImage& guide,
                                    const NonlocalOptions& options, const RunContext& context);

}  // namespace foresight
