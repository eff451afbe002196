#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/fitting/roi.h"

namespace foresight {

/// A rectangle as it was drawn over the cloud, and how the cloud was looked at.
struct CloudRectangle {
  /// Homogeneous: x, y and z over w are in [-1, 1] where a point is seen, y up; w is the distance
  /// along the line of sight, metres.
  Eigen::Matrix4d clip_from_robot = Eigen::Matrix4d::Identity();
  PixelBox corners;  ///< in the same [-1, 1]
};

/// The box, along the robot's axes, round what a rectangle shows of a cloud: the nearest things
/// under it, up to the first 0.4 m of nothing behind them, a centimetre to spare. With `within` a
/// box is cut: only its points count. Points are in base; NaNs are left out. nullopt when fewer
/// than 20 points lie there.
std::optional<BoxRoi> BoxUnder(const CloudRectangle& rectangle,
                               std::span<const Eigen::Vector3f> points,
                               const Rigid<frame::Robot, frame::Base>& robot_from_base,
                               const BoxRoi* within);

}  // namespace foresight
