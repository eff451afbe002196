#include "core/fitting/valve/rim_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace foresight {
namespace {

TEST(FindRims, FindsACircleAmongOtherPoints) {
  Random random(4);
  const Eigen::Vector3d center(0.2, -0.1, 1.5);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 0.1, -1.0).normalized();
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.cross(x);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 150; ++i) {
    const double angle = random.Uniform(0.0, 6.28);
    points.push_back(center + 0.12 * (std::cos(angle) * x + std::sin(angle) * y) +
                     0.005 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  }
  for (int i = 0; i < 150; ++i)
    points.push_back(center + Eigen::Vector3d(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2),
                                              random.Uniform(-0.1, 0.1)));
  RimSearchOptions options;
  options.facing = -Eigen::Vector3d::UnitZ();
  const auto rims = FindRims(points, options, random);
  ASSERT_FALSE(rims.empty());
  // Three noisy points, not yet refined: a centimetre and a few degrees are a start for the rest.
  EXPECT_LT((rims[0].center - center).norm(), 0.010);
  EXPECT_NEAR(rims[0].radius_m, 0.12, 0.008);
  EXPECT_GT(rims[0].axis.dot(axis), std::cos(0.12));
}

TEST(FindRims, HypothesesDifferFromEachOther) {
  Random random(5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 200; ++i)
    points.emplace_back(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), 1.0);
  const auto rims = FindRims(points, {}, random);
  ASSERT_GE(rims.size(), 2U);
  for (std::size_t i = 1; i < rims.size(); ++i)
    EXPECT_GT(
        (rims[i].center - rims[0].center).norm() + std::abs(rims[i].radius_m - rims[0].radius_m),
        0.005);
}

TEST(FindRims, FindsNothingInTwoPoints) {
  Random random(6);
  const std::vector<Eigen::Vector3d> points = {{0, 0, 1}, {0, 0.1, 1}};
  EXPECT_TRUE(FindRims(points, {}, random).empty());
}

}  // namespace
}  // namespace foresight
