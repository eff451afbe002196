#include "core/sensor/lidar_line.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

TEST(LidarModel, TheMiddleBeamLooksAhead) {
  const LidarModel lidar;
  EXPECT_NEAR(lidar.BeamAngle(540), 0.0, 1e-12);
  EXPECT_LT((lidar.BeamDirection(540) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

TEST(LidarModel, BeamsRunCounterClockwise) {
  EXPECT_GT(LidarModel().BeamDirection(541).y(), 0.0);
}

TEST(LidarModel, TheLastBeamFiresThreeQuartersOfATurnAfterTheFirst) {
  // 1080 of 1440 steps of 25 ms.
  EXPECT_NEAR(LidarModel().BeamTime(1080), 0.01875, 1e-12);
}

TEST(LidarLine, AStatusCodeIsNoRange) {
  LidarLine line;
  line.range_mm = {1, 22, 23, 1500};
  EXPECT_TRUE(std::isnan(line.RawRange(0)));
  EXPECT_TRUE(std::isnan(line.RawRange(1)));
  EXPECT_DOUBLE_EQ(line.RawRange(2), 0.023);
  EXPECT_DOUBLE_EQ(line.RawRange(3), 1.5);
}

TEST(LidarModel, RefusesMoreThanATurn) {
  LidarModel lidar;
  lidar.angle_step_rad = RadiansFromDegrees(0.5);
  EXPECT_FALSE(lidar.Check());
}

}  // namespace
}  // namespace foresight
