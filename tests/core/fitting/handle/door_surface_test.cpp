#include "core/fitting/handle/door_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kLeaf_m = 1.2;  // ahead, along x
constexpr double kFrame_m = 1.18;
constexpr double kEdge_m = 0.05;  // y of the edge; the frame is beyond it

HandleCandidate Handle() {
  HandleCandidate handle;
  Eigen::Matrix3d axes;  // the lever points to -y, the door's normal is -x
  axes.col(0) = -Eigen::Vector3d::UnitY();
  axes.col(2) = -Eigen::Vector3d::UnitX();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  handle.base_from_object = {Eigen::Quaterniond(axes),
                             {kLeaf_m - handle.model.standoff_m, 0.0, 0.0}};
  return handle;
}

/// Rays from the origin to a leaf and a frame that stands before it, or to the leaf alone.
RaySet RaysTo(bool framed, double sigma_m, std::uint64_t seed) {
  Random random(seed);
  RaySet set;
  set.sigma_m = sigma_m;
  for (int line = -16; line <= 16; ++line)
    for (int beam = -16; beam <= 16; ++beam) {
      RangeRay ray;
      ray.origin.setZero();
      ray.direction = Eigen::Vector3d(1.0, 0.007 * line, 0.007 * beam).normalized();
      const bool on_frame = framed && ray.direction.y() / ray.direction.x() * kFrame_m > kEdge_m;
      ray.range_m = (on_frame ? kFrame_m : kLeaf_m) / ray.direction.x() + sigma_m * random.Normal();
      set.rays.push_back(ray);
    }
  return set;
}

Plane ThroughAll(const RaySet& rays) {
  std::vector<Eigen::Vector3d> points;
  for (const RangeRay& ray : rays.rays) points.push_back(ray.Point());
  const Plane plane = FitPlane(points).value();
  return plane.normal.x() < 0.0 ? plane : Plane{-plane.normal, -plane.offset};
}

double OffDeg(const Plane& plane) {
  return DegreesFromRadians(std::acos(std::min(1.0, plane.normal.dot(-Eigen::Vector3d::UnitX()))));
}

TEST(DoorSurface, ALeafAndItsFrameAreTwoPlanes) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const RaySet rays = RaysTo(true, 0.008, seed);
    const Plane rough = ThroughAll(rays);
    ASSERT_GT(OffDeg(rough), 3.0) << "a plane through both";
    const DoorSurface found = DoorRound(rays, rough, false, Handle());
    EXPECT_LT(OffDeg(found.door), 0.7) << "seed " << seed;
    EXPECT_NEAR(found.door.offset, -kLeaf_m, 0.003) << "the leaf, where the pivot is";
    ASSERT_TRUE(found.beside) << "seed " << seed;
    EXPECT_NEAR(found.beside->offset, -kFrame_m, 0.003);
  }
}

TEST(DoorSurface, AFlatDoorHasNoEdge) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const RaySet rays = RaysTo(false, 0.015, seed);
    const DoorSurface found = DoorRound(rays, ThroughAll(rays), false, Handle());
    EXPECT_FALSE(found.beside) << "seed " << seed;
    EXPECT_LT(OffDeg(found.door), 1.0);
    EXPECT_NEAR(found.door.offset, -kLeaf_m, 0.003);
  }
}

TEST(DoorSurface, ANormalThatIsKnownIsKept) {
  const RaySet rays = RaysTo(true, 0.030, 3);  // more noise than the step
  const Plane rough{-Eigen::Vector3d::UnitX(), -kLeaf_m};
  EXPECT_GT(OffDeg(DoorRound(rays, rough, false, Handle()).door), 1.0);
  EXPECT_LT(OffDeg(DoorRound(rays, rough, true, Handle()).door), 0.5);
}

TEST(DoorSurface, TooFewRaysLeaveTheRoughPlane) {
  RaySet rays = RaysTo(false, 0.010, 1);
  rays.rays.resize(30);
  const Plane rough{-Eigen::Vector3d::UnitX(), -kLeaf_m};
  const DoorSurface found = DoorRound(rays, rough, false, Handle());
  EXPECT_EQ(found.door.offset, rough.offset);
  EXPECT_FALSE(found.beside);
}

}  // namespace
}  // namespace foresight
