#include "core/geometry/rigid.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

template <class A, class B>
concept Composes = requires(A a, B b) {
  a* b;
};

using CameraFromHead = Rigid<frame::Camera, frame::Head>;
using HeadFromBaseTransform = Rigid<frame::Head, frame::Base>;

TEST(Rigid, OnlyMatchingFramesCompose) {
  static_assert(Composes<CameraFromHead, HeadFromBaseTransform>);
  static_assert(!Composes<HeadFromBaseTransform, CameraFromHead>);
  static_assert(std::is_same_v<decltype(CameraFromHead() * HeadFromBaseTransform()),
                               Rigid<frame::Camera, frame::Base>>);
}

TEST(Rigid, ItsInverseUndoesIt) {
  const CameraFromHead transform(Eigen::Quaterniond(0.3, -0.5, 0.2, 0.7),
                                 Eigen::Vector3d(1, -2, 3));
  const Eigen::Vector3d point(0.4, 5.0, -6.0);
  EXPECT_LT((transform.Inverse() * (transform * point) - point).norm(), 1e-14);
}

TEST(Rigid, AgreesWithItsMatrix) {
  const CameraFromHead transform(Eigen::Quaterniond(0.9, 0.1, -0.2, 0.4), Eigen::Vector3d(1, 2, 3));
  const Eigen::Vector3d point(-1, 0.5, 2);
  EXPECT_LT(((transform.Matrix() * point.homogeneous()).head<3>() - transform * point).norm(),
            1e-14);
}

TEST(HeadFromBase, IsEquationFour) {
  const double angle = RadiansFromDegrees(25.0);
  Eigen::Matrix3d printed;
  printed << 1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle);
  EXPECT_LT((HeadFromBase(angle).RotationMatrix() - printed).norm(), 1e-15);
}

TEST(HeadFromBase, APositiveAngleLooksUp) {
  // base: y points down, so what the turned head sees straight ahead has a negative y.
  const Eigen::Vector3d ahead =
      HeadFromBase(RadiansFromDegrees(10.0)).Inverse().Rotate(Eigen::Vector3d::UnitZ());
  EXPECT_LT(ahead.y(), 0.0);
}

}  // namespace
}  // namespace foresight
