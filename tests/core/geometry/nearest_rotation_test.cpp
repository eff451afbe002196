#include "core/geometry/nearest_rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

Eigen::Matrix3d SomeMatrix(Random& random) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = random.Normal();
  return matrix;
}

Eigen::Matrix3d SomeRotation(Random& random) {
  return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
      .normalized()
      .toRotationMatrix();
}

TEST(NearestRotation, IsARotationAndNoOtherIsNearer) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d matrix = SomeMatrix(random);
    const Eigen::Matrix3d nearest = NearestRotation(matrix);
    EXPECT_NEAR(nearest.determinant(), 1.0, 1e-12);
    EXPECT_TRUE((nearest * nearest.transpose()).isIdentity(1e-12));
    for (int other = 0; other < 50; ++other)
      EXPECT_GE((SomeRotation(random) - matrix).norm(), (nearest - matrix).norm());
  }
}

TEST(NearestRotation, BringsVectorsToTheirImages) {
  Random random(5);
  const Eigen::Matrix3d rotation = SomeRotation(random);
  const Eigen::Matrix3d from = SomeMatrix(random);
  EXPECT_TRUE(NearestRotation(rotation * from * from.transpose()).isApprox(rotation, 1e-9));
}

TEST(SymmetricEigen, MakesTheMatrixAgain) {
  Random random(6);
  const Eigen::Matrix3d half = SomeMatrix(random);
  const SymmetricEigen eigen = EigenOf(half * half.transpose());
  EXPECT_LE(eigen.values[0], eigen.values[1]);
  EXPECT_LE(eigen.values[1], eigen.values[2]);
  EXPECT_TRUE((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose())
                  .isApprox(half * half.transpose(), 1e-12));
}

}  // namespace
}  // namespace foresight
