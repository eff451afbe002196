#include "ui/viewmodels/clip_box_model.h"

#include <algorithm>

namespace foresight {

void ClipBoxModel::SetBox(const Eigen::AlignedBox3d& box) {
  Eigen::Vector3d low = box.min(), high = box.max();
  if (!low.allFinite() || !high.allFinite()) return;
  for (int axis = 0; axis < 3; ++axis) {
    if (low[axis] > high[axis]) std::swap(low[axis], high[axis]);
    high[axis] = std::max(high[axis], low[axis] + kShortest_m);
  }
  box_ = {low, high};
  Q_EMIT changed();
}

void ClipBoxModel::reset() {
  const Eigen::AlignedBox3d whole =
      bounds_.isEmpty()
          ? Eigen::AlignedBox3d(Eigen::Vector3d::Constant(-2.0), Eigen::Vector3d::Constant(2.0))
          : bounds_;
  SetBox({whole.center() - 0.25 * whole.sizes(), whole.center() + 0.25 * whole.sizes()});
}

void ClipBoxModel::setOn(bool on) {
  if (on == on_) return;
  on_ = on;
  if (on && box_.isEmpty()) reset();
  Q_EMIT changed();
}

}  // namespace foresight
