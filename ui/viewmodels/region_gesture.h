#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ui/viewmodels/fit_view_model.h"

namespace foresight {

/// A region on its way, drawn with mouse and keys, in pixels of the image. A rectangle is
/// dragged; a polygon's corners are clicked, Backspace takes the last one back, Enter or a double
/// click closes it; two clicks are two clicks. Escape ends any of them without a region.
class RegionGesture {
 public:
  using Points = std::vector<Eigen::Vector2d>;

  void SetShape(RegionShape shape);
  bool Active() const { return !points_.empty(); }

  /// The finished region's points, if this ended it.
  std::optional<Points> Press(const Eigen::Vector2d& pixel);
  void Move(const Eigen::Vector2d& pixel);
  std::optional<Points> Release(const Eigen::Vector2d& pixel);
  /// A double click: closes a polygon.
  std::optional<Points> Close();
  void Cancel() { points_.clear(); }
  /// A key (Qt::Key). Outer nullopt: it means nothing to a region; else as above.
  std::optional<std::optional<Points>> Key(int key);

  /// What to show meanwhile, as a closed polygon; empty when nothing is on its way.
  Points Preview() const;

 private:
  std::optional<Points> End();

  RegionShape shape_ = RegionShape::kRectangle;
  Points points_;
  Eigen::Vector2d mouse_ = Eigen::Vector2d::Zero();
};

}  // namespace foresight
