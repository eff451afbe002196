#include "core/registration/cloud_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace foresight {
namespace {

using Cloud = std::vector<Eigen::Vector3f>;

Cloud RandomCloud(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
    cloud.emplace_back(static_cast<float>(random.Normal()), static_cast<float>(random.Normal()),
                       static_cast<float>(0.1 * random.Normal()));
  return cloud;
}

Eigen::Vector3f OnGrid(int x, int y) {
  return {static_cast<float>(x), static_cast<float>(y), 0.0f};
}

/// Every pair, as the definition says.
std::vector<float> BruteForce(const Cloud& from, const Cloud& to) {
  std::vector<float> distances;
  for (const Eigen::Vector3f& point : from) {
    double best = INFINITY;
    for (const Eigen::Vector3f& other : to)
      best = std::min(best, (point.cast<double>() - other.cast<double>()).squaredNorm());
    distances.push_back(static_cast<float>(std::sqrt(best)));
  }
  return distances;
}

TEST(CloudDistance, EqualsBruteForceToTheLastBit) {
  for (const std::size_t count : {1u, 11u, 12u, 13u, 500u, 3000u}) {
    const Cloud from = RandomCloud(1, 700), to = RandomCloud(2, count);
    EXPECT_EQ(NearestDistances(from, to, {}).value(), BruteForce(from, to)) << count;
  }
}

TEST(CloudDistance, PointsOnAGridWithManyEqualCoordinatesEqualBruteForce) {
  Cloud to;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y) to.push_back(0.1f * OnGrid(x, y));
  const Cloud from = RandomCloud(3, 400);
  EXPECT_EQ(NearestDistances(from, to, {}).value(), BruteForce(from, to));
}

TEST(CloudDistance, IsTheSameWithOneThreadAndWithMany) {
  const Cloud from = RandomCloud(4, 20'000), to = RandomCloud(5, 9000);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(NearestDistances(from, to, one).value(), NearestDistances(from, to, four).value());
}

TEST(CloudDistance, ACloudMovedOffItsPlaneIsAsFarAsItWasMoved) {
  Cloud plane, moved;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y) {
      plane.push_back(0.05f * OnGrid(x, y));
      moved.push_back(0.05f * OnGrid(x, y) + Eigen::Vector3f(0.0f, 0.0f, 0.0125f));
    }
  const CloudDistance distance = DistanceOfClouds(plane, moved, {}).value();
  EXPECT_EQ(distance.points, 3600u);
  EXPECT_NEAR(distance.median_m, 0.0125, 1e-6);
  EXPECT_NEAR(distance.p95_m, 0.0125, 1e-6);
  EXPECT_NEAR(distance.max_m, 0.0125, 1e-6);
}

TEST(CloudDistance, WhatIsInOneCloudOnlyIsSeenFromThatOne) {
  const Cloud wall = RandomCloud(6, 1000);
  Cloud with_object = wall;
  with_object.emplace_back(0.0f, 0.0f, 9.0f);
  EXPECT_EQ(DistanceOfClouds(wall, with_object, {})->max_m, 0.0);
  EXPECT_GT(DistanceOfClouds(with_object, wall, {})->max_m, 8.0);
}

TEST(CloudDistance, PointsThatAreNotFiniteCountNowhere) {
  const float nan = std::nanf("");
  const Cloud from = {{0.0f, 0.0f, 0.0f}, {nan, 0.0f, 0.0f}},
              to = {{nan, nan, nan}, {3.0f, 4.0f, 0.0f}};
  EXPECT_EQ(NearestDistances(from, to, {}).value(), std::vector<float>{5.0f});
}

TEST(CloudDistance, AnEmptyCloudAndACancelledCallAreToldApart) {
  const Cloud cloud = RandomCloud(7, 100);
  EXPECT_EQ(DistanceOfClouds({}, cloud, {}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(DistanceOfClouds(cloud, Cloud{}, {}).error().code, ErrorCode::kTooFewPoints);
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(DistanceOfClouds(cloud, cloud, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace foresight
