#include "core/sensor/sensor_rig.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

TEST(SensorRig, SurvivesItsFile) {
  const TemporaryFolder folder;
  SensorRig rig = DefaultSensorRig();
  rig.name = "head \"7\": left";
  rig.lidar.range_offset_m = 0.0123;
  rig.angle_correction =
      AngleCorrection::FromKnots({{-0.5, -0.499}, {0.0, 0.0}, {0.5, 0.501}}).value();
  ASSERT_TRUE(SaveSensorRig(rig, folder / "rig.yaml"));
  const auto loaded = LoadSensorRig(folder / "rig.yaml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->name, rig.name);
  EXPECT_EQ(loaded->camera, rig.camera);
  EXPECT_EQ(loaded->lidar, rig.lidar);
  EXPECT_EQ(loaded->angle_correction, rig.angle_correction);
  EXPECT_LT((loaded->camera_from_lidar.Matrix() - rig.camera_from_lidar.Matrix()).norm(), 1e-14);
}

TEST(SensorRig, NamesTheLineOfATypo) {
  std::string yaml = SensorRigToYaml(DefaultSensorRig());
  yaml.replace(yaml.find("  fx:"), 5, "  ffx:");
  const auto rig = SensorRigFromYaml(yaml, "rig.yaml");
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ErrorCode::kBadData);
  EXPECT_NE(rig.error().message.find("rig.yaml:5: 'fx' is missing"), std::string::npos)
      << rig.error().message;
}

TEST(SensorRig, RefusesAnUnknownKeyAnUnknownVersionAndARotationThatIsNone) {
  const std::string yaml = SensorRigToYaml(DefaultSensorRig());
  EXPECT_FALSE(SensorRigFromYaml(yaml + "extra: 1\n", "rig"));
  std::string newer = yaml;
  newer.replace(newer.find("foresight_rig: 1"), 16, "foresight_rig: 9");
  EXPECT_FALSE(SensorRigFromYaml(newer, "rig"));
  std::string bent = yaml;
  bent.replace(bent.find("quaternion_wxyz: ["), 18, "quaternion_wxyz: [7");
  EXPECT_FALSE(SensorRigFromYaml(bent, "rig"));
}

TEST(SensorRig, RefusesASensorThatIsNotOnTheHead) {
  SensorRig rig = DefaultSensorRig();
  rig.camera_from_lidar = {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 70.0)};
  EXPECT_FALSE(rig.Check());
}

TEST(DefaultSensorRig, ItsLidarSeesItsMiddleBeamAheadOfTheCamera) {
  const SensorRig rig = DefaultSensorRig();
  const Eigen::Vector3d ahead = rig.camera_from_lidar.Rotate(rig.lidar.BeamDirection(540));
  EXPECT_LT((ahead - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  // Beams run counter-clockwise seen from above: to the left, against the camera's x.
  EXPECT_LT(rig.camera_from_lidar.Rotate(rig.lidar.BeamDirection(700)).x(), 0.0);
}

TEST(DefaultSensorRig, IsTheExampleThatIsShipped) {
  const auto shipped = LoadSensorRig(FORESIGHT_SOURCE_DIR "/resources/rigs/default.yaml");
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(SensorRigToYaml(*shipped), SensorRigToYaml(DefaultSensorRig()));
}

TEST(DefaultSensorRig, LooksAlongTheRobotsXAxis) {
  const Eigen::Vector3d ahead = DefaultSensorRig().robot_from_base.Rotate(Eigen::Vector3d::UnitZ());
  EXPECT_LT((ahead - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

}  // namespace
}  // namespace foresight
