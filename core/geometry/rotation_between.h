#pragma once

#include <Eigen/Geometry>

namespace foresight {

/// The smallest rotation that turns the direction of `from` into that of `to`. Neither has to be of
/// length 1; neither may be zero. Opposite directions: a half turn about some axis across them.
///
/// Eigen's own, compiled once: every file that calls it directly compiles a singular value
/// decomposition, five seconds each.
Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace foresight
