#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/geometry/frames.h"

namespace foresight {

/// The rigid transform that takes coordinates in `From` to coordinates in `To`, metres. Only
/// matching frames compose: camera_from_base = camera_from_head * head_from_base; the inner names
/// cancel.
template <class To, class From>
class Rigid {
 public:
  Rigid() = default;
  Rigid(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
      : rotation_(rotation.normalized()), translation_(translation) {}
  Rigid(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : Rigid(Eigen::Quaterniond(rotation), translation) {}

  static Rigid Identity() { return {}; }

  /// From a rotation that has the length 1 to the last digits: it is kept bit for bit, as a file
  /// has it, where the constructor would divide by the length once more.
  static Rigid FromUnit(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
    Rigid rigid;
    rigid.rotation_ = rotation;
    rigid.translation_ = translation;
    return rigid;
  }

  const Eigen::Quaterniond& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }
  Eigen::Matrix3d RotationMatrix() const { return rotation_.toRotationMatrix(); }
  Eigen::Matrix4d Matrix() const {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = RotationMatrix();
    matrix.topRightCorner<3, 1>() = translation_;
    return matrix;
  }

  Rigid<From, To> Inverse() const {
    const Eigen::Quaterniond inverse = rotation_.conjugate();
    return Rigid<From, To>(inverse, -(inverse * translation_));
  }

  /// A point given in `From`, in `To`.
  Eigen::Vector3d operator*(const Eigen::Vector3d& point_in_from) const {
    return rotation_ * point_in_from + translation_;
  }
  /// A direction given in `From`, in `To`.
  Eigen::Vector3d Rotate(const Eigen::Vector3d& direction_in_from) const {
    return rotation_ * direction_in_from;
  }

  template <class Inner>
  Rigid<To, Inner> operator*(const Rigid<From, Inner>& from_inner) const {
    return Rigid<To, Inner>(rotation_ * from_inner.rotation(),
                            rotation_ * from_inner.translation() + translation_);
  }

 private:
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

/// The head turned by the motor, Eq. (4): R_theta = Rot_x(-angle). Positive angles look up.
inline Rigid<frame::Head, frame::Base> HeadFromBase(double angle_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(-angle_rad, Eigen::Vector3d::UnitX())),
          Eigen::Vector3d::Zero()};
}

}  // namespace foresight
