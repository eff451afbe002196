#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/geometry/rigid.h"

namespace foresight {

/// The matrix with Skew(a) b = a x b.
inline Eigen::Matrix3d Skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d skew;
  skew << 0.0, -a.z(), a.y(),  //
      a.z(), 0.0, -a.x(),      //
      -a.y(), a.x(), 0.0;
  return skew;
}

/// The rotation about `turn_rad` by its length.
inline Eigen::Quaterniond RotationExp(const Eigen::Vector3d& turn_rad) {
  const double half = 0.5 * turn_rad.norm();
  const double scale = half < 1e-6 ? 0.5 * (1.0 - half * half / 6.0) : 0.5 * std::sin(half) / half;
  const Eigen::Vector3d v = scale * turn_rad;
  return Eigen::Quaterniond(std::cos(half), v.x(), v.y(), v.z());
}

/// The inverse of RotationExp, of length pi at most.
inline Eigen::Vector3d RotationLog(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * rotation.vec();
  const double sine = v.norm();
  if (sine < 1e-9) return 2.0 * v;
  return (2.0 * std::atan2(sine, sign * rotation.w()) / sine) * v;
}

/// A small motion (turn, shift) in the frame `From`: R <- R exp(turn), t <- t + R shift.
template <class To, class From>
Rigid<To, From> Perturbed(const Rigid<To, From>& rigid, const Eigen::Matrix<double, 6, 1>& step) {
  return {rigid.rotation() * RotationExp(step.head<3>()),
          rigid.translation() + rigid.Rotate(step.tail<3>())};
}

/// The step that takes `from` to `to`, to first order in the shift: Perturbed's inverse.
template <class To, class From>
Eigen::Matrix<double, 6, 1> StepBetween(const Rigid<To, From>& from, const Rigid<To, From>& to) {
  Eigen::Matrix<double, 6, 1> step;
  step << RotationLog(from.rotation().conjugate() * to.rotation()),
      from.rotation().conjugate() * (to.translation() - from.translation());
  return step;
}

}  // namespace foresight
