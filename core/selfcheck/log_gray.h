#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/base/image.h"

namespace foresight {

/// The logarithm of an image's brightness, log1p of (0.30 r + 0.59 g + 0.11 b): what the light does
/// to it is a sum.
FloatImage LogGray(const ColorImage& image);

/// Between the four pixels around a place; NaN outside of the image. The searches ask for it
/// millions of times.
inline double Interpolated(const FloatImage& image, const Eigen::Vector2d& at) {
  // NaN fails the comparison.
  if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < image.width() - 1 &&
        at.y() < image.height() - 1))
    return std::nan("");
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  const double fx = at.x() - x, fy = at.y() - y;
  return (1.0 - fy) * ((1.0 - fx) * image(x, y) + fx * image(x + 1, y)) +
         fy * ((1.0 - fx) * image(x, y + 1) + fx * image(x + 1, y + 1));
}

/// Smoothed by a Gaussian of `sigma_px`.
FloatImage Blurred(const FloatImage& image, double sigma_px);

/// The mean of a square around each pixel, `side_px` wide: as quick for any width.
FloatImage BoxMean(const FloatImage& image, int side_px);

}  // namespace foresight
