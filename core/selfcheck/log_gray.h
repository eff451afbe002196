#pragma once

#include "core/base/image.h"

namespace foresight {

/// The logarithm of an image's brightness, log1p of (0.30 r + 0.59 g + 0.11 b): what the light does
/// to it is a sum.
FloatImage LogGray(const ColorImage& image);

/// Smoothed by a Gaussian of `sigma_px`.
FloatImage Blurred(const FloatImage& image, double sigma_px);

/// The mean of a square around each pixel, `side_px` wide: as quick for any width.
FloatImage BoxMean(const FloatImage& image, int side_px);

}  // namespace foresight
