#include "core/measure/pick_point.h"

#include <gtest/gtest.h>

#include "tests/core/measure/flat_room.h"

namespace foresight {
namespace {

/// A camera at the sensor that looks along x: y of robot to the left, z up.
CloudClick ClickAt(const FlatRoom& room, const Eigen::Vector3d& point) {
  CloudClick click;
  Eigen::Matrix4d view = Eigen::Matrix4d::Zero();
  view.row(0) << 0, -1, 0, room.Sensor().y();
  view.row(1) << 0, 0, 1, -room.Sensor().z();
  view.row(3) << 1, 0, 0, -room.Sensor().x();
  click.clip_from_robot = view;
  const Eigen::Vector4d clip = view * point.homogeneous();
  click.at = clip.head<2>() / clip.w();
  click.reach = {0.01, 0.01};
  return click;
}

TEST(PickReturnTest, SnapsToTheReturnUnderTheClickAndNamesItsLineAndBeam) {
  const FlatRoom room(0.01);
  const Eigen::Vector3d wanted = room.InRobot(60, 100);
  const auto picked = PickReturn(room.cloud, room.rig, "scan-1",
                                 ClickAt(room, wanted + Eigen::Vector3d(0.0, 0.002, 0.001)));
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->line, 60);
  EXPECT_EQ(picked->beam, 100);
  EXPECT_EQ(picked->scan_uuid, "scan-1");
  EXPECT_LT((picked->position_m - wanted).norm(), 1e-6);
  EXPECT_NEAR(picked->range_m, (wanted - room.Sensor()).norm(), 1e-4);
  EXPECT_NEAR(picked->sigma_m, 0.01, 0.004) << "told from the ranges around it";
  EXPECT_LT((room.Sensor() + picked->range_m * picked->ray - wanted).norm(), 1e-4);
  EXPECT_EQ(OriginText(*picked), "line 60, beam 100");
}

TEST(PickReturnTest, InventsNothingWhereNothingWasMeasured) {
  const FlatRoom room;
  const CloudClick click = ClickAt(room, {2.0, 0.0, 5.0});
  EXPECT_FALSE(PickReturn(room.cloud, room.rig, "scan-1", click));
}

TEST(PickReturnTest, TakesNothingThatIsNotShown) {
  const FlatRoom room;
  CloudClick click = ClickAt(room, room.InRobot(60, 100));
  ASSERT_TRUE(PickReturn(room.cloud, room.rig, "scan-1", click));
  click.shown = [](const Eigen::Vector3d& point) { return point.x() < 1.0; };
  EXPECT_FALSE(PickReturn(room.cloud, room.rig, "scan-1", click));
}

TEST(PickReturnTest, TakesTheNearerOfTwoSurfacesBehindEachOther) {
  FlatRoom room;
  // One return half way to another one, a little beside it.
  const Eigen::Vector3d far = room.InRobot(60, 100);
  const Eigen::Vector3d near =
      room.Sensor() + 0.5 * (far - room.Sensor()) + Eigen::Vector3d(0, 0.004, 0);
  RegisteredScan cloud = room.cloud;
  cloud.lines += 1;
  cloud.origins.push_back(Eigen::Vector3f::Zero());
  for (int beam = 0; beam < cloud.beams; ++beam) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Eigen::Vector3f point = (room.rig.robot_from_base.Inverse() * near).cast<float>();
    cloud.points.push_back(beam == 5 ? point : Eigen::Vector3f(Eigen::Vector3f::Constant(nan)));
    cloud.range_m.push_back(beam == 5 ? point.norm() : nan);
    cloud.intensity.push_back(0.0f);
  }
  const auto picked = PickReturn(cloud, room.rig, "scan-1", ClickAt(room, far));
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->line, room.cloud.lines);
  EXPECT_EQ(picked->beam, 5);
}

TEST(PickDepthTest, TakesThePixelsDepthUnlessItIsMaskedOrEmpty) {
  const SensorRig rig = DefaultSensorRig();
  CameraFrame frame;
  frame.motor_angle_rad = 0.1;
  DepthImage depth(rig.camera.width, rig.camera.height, std::numeric_limits<float>::quiet_NaN());
  MaskImage mask(rig.camera.width, rig.camera.height, 255);
  depth(700, 500) = 2.0f;
  const auto picked = PickDepth(depth, &mask, frame, rig, "scan-1", 1, 700, 500);
  ASSERT_TRUE(picked);
  const auto camera_from_robot = rig.CameraFromBase(0.1) * rig.robot_from_base.Inverse();
  const Eigen::Vector3d in_camera = camera_from_robot * picked->position_m;
  EXPECT_NEAR(in_camera.z(), 2.0, 1e-6);
  const auto pixel = rig.camera.Project(in_camera);
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Eigen::Vector2d(700, 500)).norm(), 1e-6);
  EXPECT_TRUE(std::isnan(picked->sigma_m));
  EXPECT_FALSE(PickDepth(depth, &mask, frame, rig, "scan-1", 1, 701, 500)) << "no depth there";
  EXPECT_FALSE(PickDepth(depth, &mask, frame, rig, "scan-1", 1, -1, 500));
  mask(700, 500) = 0;
  EXPECT_FALSE(PickDepth(depth, &mask, frame, rig, "scan-1", 1, 700, 500)) << "masked";
}

}  // namespace
}  // namespace foresight
