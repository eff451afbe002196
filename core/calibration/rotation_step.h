#pragma once

#include <Eigen/Geometry>

#include "core/calibration/board_pose.h"

namespace foresight {

/// The cross product as a matrix: CrossMatrix(a) b = a x b.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

/// The rotation by |step| about `step`.
inline Eigen::Quaterniond RotationOf(const Eigen::Vector3d& step) {
  const double angle = step.norm();
  // Half of sin(angle / 2) / (angle / 2), which is 1/2 - angle^2 / 48 near 0.
  const double scale = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  return Eigen::Quaterniond(std::cos(0.5 * angle), scale * step.x(), scale * step.y(),
                            scale * step.z());
}

/// A pose after a small step: turned by the first three numbers in the pattern's frame, moved by
/// the last three in the camera's. All derivatives by a pose in this folder are by this step.
using PoseStep = Eigen::Matrix<double, 6, 1>;
inline CameraFromPattern Moved(const CameraFromPattern& pose, const PoseStep& step) {
  return {pose.rotation() * RotationOf(step.head<3>()), pose.translation() + step.tail<3>()};
}

/// The derivative of pose * point by the step.
inline Eigen::Matrix<double, 3, 6> ByPoseStep(const Eigen::Matrix3d& rotation,
                                              const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 3, 6> derivative;
  derivative << -rotation * CrossMatrix(point), Eigen::Matrix3d::Identity();
  return derivative;
}

}  // namespace foresight
