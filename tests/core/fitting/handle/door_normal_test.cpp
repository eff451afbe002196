#include "core/fitting/handle/door_normal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kFaceAhead_m = 1.2;  // ahead, along x
constexpr double kRegion_m = 0.10;

/// Of a leaf, from y = -0.06 on a frame, and from y = -0.16 on a wall, `frame_m` and `wall_m`
/// nearer than the leaf; 0.45 m to every side of the x axis.
RaySet RaysRound(double frame_m, double wall_m, double sigma_m, std::uint64_t seed) {
  Random random(seed);
  RaySet set;
  set.sigma_m = sigma_m;
  for (double y = -0.45; y < 0.45; y += 0.02)
    for (double z = -0.45; z < 0.45; z += 0.02) {
      RangeRay ray;
      ray.origin.setZero();
      ray.direction = Eigen::Vector3d(kFaceAhead_m, y, z).normalized();
      const double nearer_m = y < -0.16 ? wall_m : y < -0.06 ? frame_m : 0.0;
      ray.range_m = (kFaceAhead_m - nearer_m) / ray.direction.x() + sigma_m * random.Normal();
      set.rays.push_back(ray);
    }
  return set;
}

/// What a region of 20 cm a side holds of it.
RaySet RegionOf(const RaySet& around) {
  RaySet region = around;
  std::erase_if(region.rays, [](const RangeRay& ray) {
    return ray.Point().tail<2>().cwiseAbs().maxCoeff() > kRegion_m;
  });
  return region;
}

/// As a region of few, noisy rays across an edge would have it.
Plane Tilted(double tilt_deg) {
  const double tilt = RadiansFromDegrees(tilt_deg);
  const Eigen::Vector3d normal(-std::cos(tilt), std::sin(tilt), 0.0);
  return {normal, normal.x() * kFaceAhead_m};
}

double TiltedByDeg(const Plane& plane) {
  return DegreesFromRadians(std::acos(std::min(1.0, -plane.normal.x())));
}

TEST(DoorNormal, ALeafAFrameAndAWallShareIt) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const double tilt_deg : {-9.0, 9.0}) {
      const RaySet around = RaysRound(0.025, 0.010, 0.015, seed);
      Random random(seed);
      const Plane door = DoorAmongLevels(around, RegionOf(around), Tilted(tilt_deg), random);
      EXPECT_LT(TiltedByDeg(door), 1.0) << "seed " << seed << ", " << tilt_deg;
      EXPECT_NEAR(door.offset, -kFaceAhead_m, 0.006) << "seed " << seed << ", " << tilt_deg;
    }
}

// Fewest levels are not the answer: a tilt that merges a frame and a wall 55 mm before the leaf
// leaves one level, as wide as both.
TEST(DoorNormal, AFrameFarBeforeTheLeafDoesNotTiltIt) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RaySet around = RaysRound(0.055, 0.055, 0.005, seed);
    Random random(seed);
    const Plane door = DoorAmongLevels(around, RegionOf(around), Tilted(4.0), random);
    EXPECT_LT(TiltedByDeg(door), 0.5) << "seed " << seed;
    EXPECT_NEAR(door.offset, -kFaceAhead_m, 0.004) << "seed " << seed;
  }
}

TEST(DoorNormal, FewMeasurementsOrAFarOtherSurfaceLeaveTheRoughPlane) {
  RaySet around = RaysRound(0.0, 0.0, 0.005, 1);
  Random random(1);
  const Plane elsewhere{-Eigen::Vector3d::UnitX(), -2.0};
  EXPECT_EQ(DoorAmongLevels(around, RegionOf(around), elsewhere, random).offset, elsewhere.offset);
  around.rays.resize(150);
  const Plane rough = Tilted(4.0);
  EXPECT_EQ(DoorAmongLevels(around, around, rough, random).normal, rough.normal);
}

}  // namespace
}  // namespace foresight
