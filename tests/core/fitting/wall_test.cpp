#include "core/fitting/wall.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

/// Rays from the origin to a square of points, `half_m` to both sides, at a depth.
void AddSquare(double depth_m, double half_m, RaySet& rays) {
  for (double x = -half_m; x <= half_m + 1e-9; x += half_m / 10.0)
    for (double y = -half_m; y <= half_m + 1e-9; y += half_m / 10.0) {
      const Eigen::Vector3d point(x, y, depth_m);
      rays.rays.push_back({Eigen::Vector3d::Zero(), point.normalized(), point.norm(), {-1, -1}});
    }
}

/// A wall at 2 m, a pipe's flange before it, and before that what the operator drew a box round.
RaySet FlangeBehindAWheel() {
  RaySet rays;
  AddSquare(2.0, 0.8, rays);
  AddSquare(1.7, 0.1, rays);
  AddSquare(1.2, 0.08, rays);
  return rays;
}

BoxRoi BoxAt(double depth_m, double side_m) {
  return {{Eigen::Quaterniond::Identity(), {0.0, 0.0, depth_m}}, Eigen::Vector3d::Constant(side_m)};
}

TEST(SplitWall, WhatEndsBehindTheOperatorsBoxIsNotItsObject) {
  RaySet rays = FlangeBehindAWheel();
  Random all(1), boxed(1);
  EXPECT_EQ(SplitWall(rays, all).foreground.size(), 2u * 441u);
  rays.box = BoxAt(1.2, 0.2);
  const WallSplit split = SplitWall(rays, boxed);
  ASSERT_TRUE(split.wall.has_value());
  EXPECT_NEAR(split.wall->Distance({0.0, 0.0, 2.0}), 0.0, 0.01);
  EXPECT_EQ(split.foreground.size(), 441u);
  for (const Eigen::Vector3d& point : split.foreground) EXPECT_NEAR(point.z(), 1.2, 1e-9);
}

TEST(SplitWall, ABoxThatHoldsHardlyAnythingTellsLessThanTheWall) {
  RaySet rays = FlangeBehindAWheel();
  rays.box = BoxAt(0.6, 0.05);
  Random random(1);
  EXPECT_EQ(SplitWall(rays, random).foreground.size(), 2u * 441u);
}

TEST(NoWall, TakesNothingFlatForOne) {
  RaySet rays;
  AddSquare(2.0, 0.8, rays);
  const WallSplit split = NoWall(rays);
  EXPECT_FALSE(split.wall.has_value());
  EXPECT_EQ(split.foreground.size(), rays.rays.size());
}

}  // namespace
}  // namespace foresight
