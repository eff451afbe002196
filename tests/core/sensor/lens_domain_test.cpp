// Where each lens ends.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/sensor/camera_model.h"

namespace foresight {
namespace {

Eigen::Vector3d At(double angle_rad, double azimuth_rad) {
  return {std::sin(angle_rad) * std::cos(azimuth_rad), std::sin(angle_rad) * std::sin(azimuth_rad),
          std::cos(angle_rad)};
}

/// The lens shows what lies within `end_rad` of the axis, in every direction, and nothing beyond.
template <class L>
void ExpectEnd(const L& lens, double end_rad) {
  for (double azimuth = 0.0; azimuth < 6.28; azimuth += 0.37) {
    EXPECT_TRUE(lens.Project(At(end_rad - 1e-6, azimuth), nullptr, nullptr)) << azimuth;
    EXPECT_FALSE(lens.Project(At(end_rad + 1e-6, azimuth), nullptr, nullptr)) << azimuth;
  }
}

TEST(RadialTangentialLens, EndsWhereItsRadiusStopsGrowing) {
  // r (1 - 0.3 r^2) grows up to r^2 = 1 / 0.9.
  const RadialTangentialLens lens(-0.3, 0.0, 0.0, 0.0, 0.0);
  EXPECT_NEAR(lens.max_slope(), std::sqrt(1.0 / 0.9), 1e-12);
  ExpectEnd(lens, std::atan(std::sqrt(1.0 / 0.9)));
  // There the image ends too: its largest radius is 2/3 of that.
  const double largest = 2.0 / 3.0 * std::sqrt(1.0 / 0.9);
  EXPECT_TRUE(lens.Unproject({largest - 1e-9, 0.0}));
  EXPECT_FALSE(lens.Unproject({largest + 1e-9, 0.0}));
}

TEST(RadialTangentialLens, EndsAtTheFirstFoldOfSeveral) {
  // d/dr = 1 - 3 r^2 + 1.75 r^4 - 0.2 r^6 changes its sign three times.
  const RadialTangentialLens lens(-1.0, 0.35, 0.0, 0.0, -0.2 / 7.0);
  double first = 0.0;
  while (1 - 3 * first * first + 1.75 * std::pow(first, 4) - 0.2 * std::pow(first, 6) > 0.0)
    first += 1e-5;
  EXPECT_NEAR(lens.max_slope(), first, 2e-5);
}

TEST(RadialTangentialLens, TangentialDistortionLeavesNoFoldInsideTheLens) {
  // The derivative by (x, y) must keep a positive determinant: it is 0 on a fold.
  const RadialTangentialLens lens(-0.2, 0.03, 0.03, -0.05, 0.0);
  EXPECT_LT(lens.max_slope(), 2.0);
  for (double azimuth = 0.0; azimuth < 6.28; azimuth += 0.1)
    for (double slope = 0.01; slope < lens.max_slope(); slope += 0.01) {
      Eigen::Matrix<double, 2, 3> by_point;
      const Eigen::Vector3d point(slope * std::cos(azimuth), slope * std::sin(azimuth), 1.0);
      ASSERT_TRUE(lens.Project(point, &by_point, nullptr));
      ASSERT_GT(by_point.leftCols<2>().determinant(), 0.0);
      ASSERT_GT(by_point(0, 0), 0.0);
    }
}

TEST(RadialTangentialLens, ShowsNothingBehindIt) {
  const RadialTangentialLens lens;
  EXPECT_TRUE(lens.Project({1.0, 0.0, 0.01}, nullptr, nullptr));
  EXPECT_FALSE(lens.Project({1.0, 0.0, 0.0}, nullptr, nullptr));
  EXPECT_FALSE(lens.Project({1.0, 0.0, -0.01}, nullptr, nullptr));
}

TEST(KannalaBrandtLens, EndsWhereItsRadiusStopsGrowing) {
  // theta (1 - 0.1 theta^2) grows up to theta^2 = 1 / 0.3.
  const KannalaBrandtLens lens(-0.1, 0.0, 0.0, 0.0);
  EXPECT_NEAR(lens.max_angle_rad(), std::sqrt(1.0 / 0.3), 1e-12);
  ExpectEnd(lens, std::sqrt(1.0 / 0.3));
  EXPECT_TRUE(lens.Unproject({0.0, lens.max_radius() - 1e-9}));
  EXPECT_FALSE(lens.Unproject({0.0, lens.max_radius() + 1e-9}));
}

TEST(KannalaBrandtLens, WithoutAFoldShowsAllButTheBackwardAxis) {
  const KannalaBrandtLens lens(0.01, 0.0, 0.0, 0.0);
  EXPECT_EQ(lens.max_angle_rad(), std::numbers::pi);
  EXPECT_TRUE(lens.Project(At(3.14159, 1.0), nullptr, nullptr));
  EXPECT_FALSE(lens.Project({0.0, 0.0, -1.0}, nullptr, nullptr));
}

TEST(ExtendedUnifiedLens, EndsAtItsCone) {
  // With beta = 1 the cone is cos(theta) > -w.
  ExpectEnd(ExtendedUnifiedLens{0.7, 1.0}, std::acos(-0.3 / 0.7));
  ExpectEnd(ExtendedUnifiedLens{0.3, 1.0}, std::acos(-0.3 / 0.7));
  ExpectEnd(ExtendedUnifiedLens{0.0, 1.0}, std::acos(0.0));
  ExpectEnd(ExtendedUnifiedLens{1.0, 1.0}, std::acos(0.0));
  const double largest = 1.0 / std::sqrt(1.3 * (2.0 * 0.7 - 1.0));
  const ExtendedUnifiedLens lens{0.7, 1.3};
  EXPECT_TRUE(lens.Unproject({largest - 1e-9, 0.0}));
  EXPECT_FALSE(lens.Unproject({largest + 1e-9, 0.0}));
}

}  // namespace
}  // namespace foresight
