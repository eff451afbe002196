#pragma once

#include "core/calibration/intrinsics.h"

namespace foresight {

/// The images that agree with each other, in a bundle under the Kannala-Brandt lens with a board
/// that may be bent.
struct SelectedImages {
  CameraBundle bundle;
  std::vector<std::size_t> images;  ///< of those given, one a view of the bundle
  std::vector<RejectedImage> rejected;
  int corners_rejected = 0;
};

/// Leaves out what contradicts the rest, as the options say: corners first, then images. The lens
/// that judges has four coefficients, so an image is not blamed for what a simpler lens cannot do.
/// Fails with kTooFewPoints where fewer than min_images, or fewer than two thirds, are left; with
/// kNoConvergence, kCancelled.
Result<SelectedImages> SelectImages(const CalibrationBoard& board,
                                    const std::vector<IntrinsicsImage>& images, int width,
                                    int height, const IntrinsicsOptions& options,
                                    const RunContext& context);

}  // namespace foresight
