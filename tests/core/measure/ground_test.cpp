#include "core/measure/ground.h"

#include <gtest/gtest.h>

#include "core/geometry/angles.h"
#include "tests/core/measure/flat_room.h"

namespace foresight {
namespace {

TEST(GroundTest, IsTheLowestLevelPlaneWhereNoTerrainWasFound) {
  const FlatRoom room(0.01);
  const auto ground = FindGround(room.cloud, room.rig, {});
  ASSERT_TRUE(ground) << ground.error().message;
  EXPECT_EQ(ground->made_from, "the lowest level plane of the scan");
  EXPECT_NEAR(ground->plane.Distance({1.0, 0.0, FlatRoom::kFloor_m}), 0.0, 0.005);
  EXPECT_GT(ground->plane.normal.z(), 0.999);
  EXPECT_GT(ground->inliers, 500);
}

TEST(GroundTest, MayTiltALittle) {
  const FlatRoom room(0.005, RadiansFromDegrees(4.0));
  const auto ground = FindGround(room.cloud, room.rig, {});
  ASSERT_TRUE(ground) << ground.error().message;
  EXPECT_NEAR(DegreesFromRadians(std::acos(ground->plane.normal.z())), 4.0, 0.3);
}

TEST(GroundTest, IsThatOfTheTerrainWhereThereIsOne) {
  const FlatRoom room;
  TerrainDetection terrain;
  TerrainSurface block, surface;
  block.kind = TerrainSurface::Kind::kBlock;
  block.size_m = {9.0, 9.0};
  surface.kind = TerrainSurface::Kind::kGround;
  surface.size_m = {1.0, 1.0};
  surface.evidence.points = 500;
  // z of the object is up: against y of base.
  surface.base_from_object = {room.rig.robot_from_base.Inverse().rotation(),
                              room.rig.robot_from_base.Inverse() * Eigen::Vector3d(1.0, 0.0, 0.13)};
  terrain.surfaces = {block, surface};
  const TerrainDetection* terrains[] = {&terrain};
  const auto ground = FindGround(room.cloud, room.rig, terrains);
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->made_from, "the terrain's ground");
  EXPECT_NEAR(ground->plane.Distance({3.0, 1.0, 0.13}), 0.0, 1e-9);
}

TEST(GroundTest, IsToldToBeMissingWhereOnlyAWallIsSeen) {
  FlatRoom room;
  RegisteredScan wall = room.cloud;
  wall.points.clear();
  for (int line = 0; line < wall.lines; ++line)
    for (int beam = 0; beam < wall.beams; ++beam) {
      const bool high = room.InRobot(line, beam).z() > FlatRoom::kFloor_m + 0.05;
      const float nan = std::numeric_limits<float>::quiet_NaN();
      wall.points.push_back(high ? room.cloud.points[wall.Index(line, beam)]
                                 : Eigen::Vector3f(Eigen::Vector3f::Constant(nan)));
    }
  EXPECT_EQ(FindGround(wall, room.rig, {}).error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace foresight
