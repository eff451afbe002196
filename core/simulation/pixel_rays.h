#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/sensor/camera_model.h"

namespace foresight {

/// CameraModel::Unproject for millions of image points: the same rays to 1e-12, several times
/// faster for the paper's lens, of which all but a table of the radius is multiplied out
/// beforehand.
class PixelRays {
 public:
  explicit PixelRays(const CameraModel& camera);

  /// The unit ray of an image point; nullopt where the lens shows nothing.
  std::optional<Eigen::Vector3d> At(const Eigen::Vector2d& pixel) const {
    const double x = (pixel.x() - camera_.cx) / camera_.fx;
    const double y = (pixel.y() - camera_.cy) / camera_.fy;
    const double place = pieces_per_q_ * (x * x + y * y);
    if (!(place < static_cast<double>(pieces_.size()))) return camera_.Unproject(pixel);
    const auto index = static_cast<std::size_t>(place);
    const Piece& piece = pieces_[index];
    const double t = place - static_cast<double>(index);
    const double s = ValueAt(piece.s, t);
    return Eigen::Vector3d(s * x, s * y, ValueAt(piece.c, t));
  }

 private:
  /// Of the squared radius q between two knots, with t in [0, 1]: the ray is (x s(t), y s(t),
  /// c(t)).
  struct Piece {
    std::array<double, 4> s;  ///< coefficients of 1, t, t^2, t^3
    std::array<double, 4> c;
  };

  static double ValueAt(const std::array<double, 4>& cubic, double t) {
    return cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3]));
  }

  CameraModel camera_;
  double pieces_per_q_ = 0.0;
  std::vector<Piece> pieces_;  ///< empty: another lens
};

}  // namespace foresight
