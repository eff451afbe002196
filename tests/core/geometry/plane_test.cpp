#include "core/geometry/plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace foresight {
namespace {

std::vector<Eigen::Vector3d> PointsOnPlane(const Plane& plane, int count, double noise,
                                           Random& random) {
  const Eigen::Vector3d a = plane.normal.unitOrthogonal();
  const Eigen::Vector3d b = plane.normal.cross(a);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back((plane.offset + noise * random.Normal()) * plane.normal +
                     random.Uniform(-1, 1) * a + random.Uniform(-1, 1) * b);
  return points;
}

TEST(FitPlane, RecoversAPlaneWithoutNoise) {
  Random random(1);
  const Plane truth{Eigen::Vector3d(1, 2, -2).normalized(), 0.7};
  const auto plane = FitPlane(PointsOnPlane(truth, 50, 0.0, random));
  ASSERT_TRUE(plane);
  EXPECT_NEAR(std::abs(plane->normal.dot(truth.normal)), 1.0, 1e-12);
}

TEST(FitPlane, RefusesPointsOnALine) {
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 10; ++i) line.push_back(i * Eigen::Vector3d(1, 1, 0));
  EXPECT_FALSE(FitPlane(line));
}

TEST(FindDominantPlane, IgnoresAThirdOfOutliers) {
  Random random(2);
  const Plane truth{Eigen::Vector3d(0, 0.1, 1).normalized(), 1.5};
  auto points = PointsOnPlane(truth, 400, 0.005, random);
  for (int i = 0; i < 200; ++i)
    points.emplace_back(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(0, 1.3));
  const auto plane = FindDominantPlane(points, {}, random);
  ASSERT_TRUE(plane);
  const double tilt = std::acos(std::min(1.0, std::abs(plane->normal.dot(truth.normal))));
  // 400 points of 5 mm over 2 m: the tilt's deviation is 0.0005 rad; outliers inside the slab add a
  // little.
  EXPECT_LT(tilt, 0.004);
}

TEST(FindDominantPlane, FindsNothingInTooFewPoints) {
  Random random(3);
  const std::vector<Eigen::Vector3d> points(5, Eigen::Vector3d::Ones());
  EXPECT_FALSE(FindDominantPlane(points, {}, random));
}

}  // namespace
}  // namespace foresight
