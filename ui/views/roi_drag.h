#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>

namespace foresight {

/// A rectangle being drawn with the mouse, in pixels of the image.
class RoiDrag {
 public:
  using Corners = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

  bool Active() const { return corners_.has_value(); }
  const std::optional<Corners>& Current() const { return corners_; }

  void Begin(const Eigen::Vector2d& pixel) { corners_ = Corners(pixel, pixel); }
  void Move(const Eigen::Vector2d& pixel) {
    if (corners_) corners_->second = pixel;
  }
  /// The finished rectangle; nullopt when none was begun or it was cancelled.
  std::optional<Corners> End() { return std::exchange(corners_, std::nullopt); }
  void Cancel() { corners_.reset(); }

 private:
  std::optional<Corners> corners_;
};

}  // namespace foresight
