#include "core/sensor/rig_id.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

TEST(RigId, IsTheSha256OfTheRigsValues) {
  // Pins the text that is hashed: ids in files of today hold for ever. docs/formats.md has it.
  EXPECT_EQ(RigId(DefaultSensorRig()),
            "3c1a0bacdbd9da83049db2b62c302adc42f6a1cae2f7d635bc19c3a8ee3d2021");
  EXPECT_EQ(ShortRigId(DefaultSensorRig()), RigId(DefaultSensorRig()).substr(0, 8));
}

TEST(RigId, ChangesWithEveryValueThatAResultDependsOn) {
  std::vector<std::string> ids = {RigId(DefaultSensorRig())};
  const auto add = [&ids](const auto& change) {
    SensorRig rig = DefaultSensorRig();
    change(rig);
    ids.push_back(RigId(rig));
  };
  add([](SensorRig& r) { r.camera.width += 1; });
  add([](SensorRig& r) { r.camera.height += 1; });
  add([](SensorRig& r) { r.camera.fx = std::nextafter(r.camera.fx, 1e9); });
  add([](SensorRig& r) { r.camera.cy += 1e-9; });
  add([](SensorRig& r) { r.camera.lens = FisheyeLens{0.9414}; });
  add([](SensorRig& r) { r.camera.lens = FisheyeLens{0.0}; });
  add([](SensorRig& r) { r.camera.lens = RadialTangentialLens(); });
  add([](SensorRig& r) { r.camera.lens = KannalaBrandtLens(); });
  add([](SensorRig& r) { r.camera.lens = KannalaBrandtLens(0, 0, 0, 1e-9); });
  add([](SensorRig& r) { r.camera.lens = ExtendedUnifiedLens(); });
  add([](SensorRig& r) { r.lidar.beams += 1; });
  add([](SensorRig& r) { r.lidar.first_angle_rad += 1e-9; });
  add([](SensorRig& r) { r.lidar.angle_step_rad += 1e-9; });
  add([](SensorRig& r) { r.lidar.period_s += 1e-9; });
  add([](SensorRig& r) { r.lidar.min_range_m += 1e-9; });
  add([](SensorRig& r) { r.lidar.max_range_m += 1e-9; });
  add([](SensorRig& r) { r.lidar.range_offset_m += 1e-9; });
  add([](SensorRig& r) { r.lidar.stamp_offset_s += 1e-9; });
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(1e-6, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d moved(1e-6, 0, 0);
  add([&](SensorRig& r) { r.camera_from_head = {turned, r.camera_from_head.translation()}; });
  add([&](SensorRig& r) { r.camera_from_head = {r.camera_from_head.rotation(), moved}; });
  add([&](SensorRig& r) { r.camera_from_lidar = {turned, r.camera_from_lidar.translation()}; });
  add([&](SensorRig& r) { r.robot_from_base = {r.robot_from_base.rotation(), moved}; });
  add([](SensorRig& r) {
    r.angle_correction = AngleCorrection::FromKnots({{-0.5, -0.499}, {0.5, 0.501}}).value();
  });
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(ids[i], ids[j]) << i << " and " << j;
}

TEST(RigId, DoesNotCountNameDateAndParent) {
  SensorRig rig = DefaultSensorRig();
  rig.name = "another";
  rig.date_utc = "2026-03-01T09:30:00Z";
  rig.parent_id = RigId(rig);
  EXPECT_EQ(RigId(rig), RigId(DefaultSensorRig()));
}

TEST(RigId, IsOneForTwoWaysToWriteOneValue) {
  SensorRig rig = DefaultSensorRig();
  rig.lidar.range_offset_m = -0.0;
  const Eigen::Quaterniond q = rig.robot_from_base.rotation();
  rig.robot_from_base = {Eigen::Quaterniond(-q.w(), -q.x(), -q.y(), -q.z()),
                         rig.robot_from_base.translation()};
  EXPECT_EQ(RigId(rig), RigId(DefaultSensorRig()));
}

TEST(CheckUtcDate, TakesDatesThatThereWere) {
  for (const char* date : {"2026-03-01T09:30:00Z", "2024-02-29T23:59:59Z", "1999-12-31T00:00:00Z"})
    EXPECT_TRUE(CheckUtcDate(date)) << date;
  for (const char* date : {"", "2026", "2026-03-01", "2026-03-01T09:30:00",
                           "2026-03-01T09:30:00+01:00", "2026-03-01 09:30:00Z",
                           "2026-13-01T09:30:00Z", "2026-02-29T09:30:00Z", "2026-03-01T24:00:00Z",
                           "2026-03-01T09:60:00Z", "2026-03-01T09:30:60Z", "2026-03-01T09:3x:00Z",
                           "2026-03-01T-1:30:00Z", "+026-03-01T09:30:00Z", "2026-03-01T09:30:00ZZ"})
    EXPECT_FALSE(CheckUtcDate(date)) << date;
}

}  // namespace
}  // namespace foresight
