#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// A rectangle of pixels along the image's sides.
struct PixelBox {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
};

/// What the operator drew on the image or the depth map: a closed polygon in pixels of one image.
struct ImageRoi {
  double motor_rad = 0.0;                ///< which image: the motor's angle it was taken at
  std::vector<Eigen::Vector2d> polygon;  ///< at least 3 corners, pixels

  static ImageRoi Rectangle(double motor_rad, const Eigen::Vector2d& corner_a,
                            const Eigen::Vector2d& corner_b);

  /// Even-odd rule; the boundary counts as inside.
  bool Contains(const Eigen::Vector2d& pixel) const;

  /// The smallest rectangle around all corners.
  PixelBox Bounds() const;

  /// Fails with kInvalidInput: fewer than 3 corners, not finite, or less than 4 px wide or high.
  Status Check() const;
};

}  // namespace foresight
