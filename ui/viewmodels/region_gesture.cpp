#include "ui/viewmodels/region_gesture.h"

#include <Qt>
#include <utility>

namespace foresight {

void RegionGesture::SetShape(RegionShape shape) {
  if (shape == shape_) return;
  shape_ = shape;
  Cancel();
}

std::optional<RegionGesture::Points> RegionGesture::End() {
  return std::exchange(points_, {});
}

std::optional<RegionGesture::Points> RegionGesture::Press(const Eigen::Vector2d& pixel) {
  mouse_ = pixel;
  if (shape_ == RegionShape::kRectangle) points_.clear();
  points_.push_back(pixel);
  if (shape_ == RegionShape::kTwoClicks && points_.size() == 2) return End();
  return std::nullopt;
}

void RegionGesture::Move(const Eigen::Vector2d& pixel) {
  mouse_ = pixel;
}

std::optional<RegionGesture::Points> RegionGesture::Release(const Eigen::Vector2d& pixel) {
  mouse_ = pixel;
  if (shape_ != RegionShape::kRectangle || !Active()) return std::nullopt;
  points_.push_back(pixel);
  return End();
}

std::optional<RegionGesture::Points> RegionGesture::Close() {
  if (shape_ != RegionShape::kPolygon || points_.size() < 3) return std::nullopt;
  return End();
}

std::optional<std::optional<RegionGesture::Points>> RegionGesture::Key(int key) {
  using Handled = std::optional<std::optional<Points>>;
  if (!Active()) return std::nullopt;
  if (key == Qt::Key_Escape) {
    Cancel();
    return Handled(std::in_place, std::nullopt);
  }
  if (shape_ == RegionShape::kRectangle) return std::nullopt;
  if (key == Qt::Key_Backspace) {
    points_.pop_back();
    return Handled(std::in_place, std::nullopt);
  }
  if (key == Qt::Key_Return || key == Qt::Key_Enter) return Handled(std::in_place, Close());
  return std::nullopt;
}

RegionGesture::Points RegionGesture::Preview() const {
  if (!Active()) return {};
  Points points = points_;
  points.push_back(mouse_);
  switch (shape_) {
    case RegionShape::kRectangle:
      return ImageRoi::Rectangle(0.0, points.front(), points.back()).polygon;
    case RegionShape::kTwoClicks:
      return ImageRoi::AroundTwoClicks(0.0, points.front(), points.back()).polygon;
    case RegionShape::kPolygon:
      break;
  }
  return points;
}

}  // namespace foresight
