#include "core/sensor/sensor_rig.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/base/random.h"
#include "core/sensor/rig_id.h"
#include "tests/core/sensor/known_cameras.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

/// As programs before the id wrote it.
constexpr const char* kOldYaml = R"(foresight_rig: 1
name: "default"
camera:
  model: fisheye_k
  width: 1288
  height: 964
  fx: 601
  fy: 601
  cx: 643.5
  cy: 481.5
  k: 0.9413
lidar:
  beams: 1081
  first_angle_rad: -2.356194490192345
  angle_step_rad: 0.004363323129985824
  period_s: 0.025
  min_range_m: 0.1
  max_range_m: 30
  range_offset_m: 0
  stamp_offset_s: 0
camera_from_head: {quaternion_wxyz: [1, 0, 0, 0], translation_m: [0, 0.035, -0.04]}
camera_from_lidar: {quaternion_wxyz: [0.5, 0.5, -0.5, 0.5], translation_m: [0, 0.07, -0.015]}
robot_from_base: {quaternion_wxyz: [-0.5, 0.5, -0.5, 0.5], translation_m: [0.1, 0, 1.4]}
)";

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
  EXPECT_EQ(loaded->camera_from_lidar.Matrix(), rig.camera_from_lidar.Matrix());
}

/// A rig whose every number needs all of its digits.
SensorRig OddRig(const Lens& lens) {
  Random random(11);
  const auto odd = [&random](double about) { return about * random.Uniform(0.9, 1.1); };
  const auto rotation = [&random] {
    return Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal());
  };
  const auto translation = [&random] {
    return Eigen::Vector3d(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), -0.0);
  };
  SensorRig rig = DefaultSensorRig();
  rig.name = "head \"7\": left";
  rig.date_utc = "2026-03-01T09:30:00Z";
  rig.parent_id = RigId(DefaultSensorRig());
  rig.camera.fx = odd(600);
  rig.camera.fy = odd(600);
  rig.camera.cx = odd(640);
  rig.camera.cy = odd(480);
  rig.camera.lens = lens;
  rig.lidar.period_s = odd(0.025);
  rig.lidar.range_offset_m = odd(0.01);
  rig.camera_from_head = {rotation(), translation()};
  rig.camera_from_lidar = {rotation(), translation()};
  rig.robot_from_base = {rotation(), translation()};
  rig.angle_correction =
      AngleCorrection::FromKnots({{-0.5, odd(-0.5)}, {0.0, 0.0}, {0.5, odd(0.5)}}).value();
  return rig;
}

/// Tells 0 from -0.
template <class To, class From>
bool SameBits(const Rigid<To, From>& a, const Rigid<To, From>& b) {
  return std::memcmp(a.rotation().coeffs().data(), b.rotation().coeffs().data(),
                     4 * sizeof(double)) == 0 &&
         std::memcmp(a.translation().data(), b.translation().data(), 3 * sizeof(double)) == 0;
}

TEST(SensorRig, OfEveryModelSurvivesItsYamlBitForBit) {
  for (const KnownCamera& known : KnownCameras()) {
    SCOPED_TRACE(known.what);
    const SensorRig rig = OddRig(known.camera.lens);
    const std::string yaml = SensorRigToYaml(rig);
    const auto read = SensorRigFromYaml(yaml, "rig.yaml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->name, rig.name);
    EXPECT_EQ(read->date_utc, rig.date_utc);
    EXPECT_EQ(read->parent_id, rig.parent_id);
    EXPECT_EQ(read->camera, rig.camera);
    EXPECT_EQ(read->lidar, rig.lidar);
    EXPECT_EQ(read->angle_correction, rig.angle_correction);
    EXPECT_TRUE(SameBits(read->camera_from_head, rig.camera_from_head));
    EXPECT_TRUE(SameBits(read->camera_from_lidar, rig.camera_from_lidar));
    EXPECT_TRUE(SameBits(read->robot_from_base, rig.robot_from_base));
    EXPECT_EQ(SensorRigToYaml(*read), yaml);
    EXPECT_EQ(RigId(*read), RigId(rig));
  }
}

TEST(SensorRig, RotationsSurviveTheYamlBitForBit) {
  // The length of a rotation that was made to be 1 is 1 but for its last bits; dividing by it once
  // more would change one rotation in some.
  Random random(12);
  for (int i = 0; i < 500; ++i) {
    SensorRig rig = DefaultSensorRig();
    rig.robot_from_base = {
        Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal()),
        Eigen::Vector3d::Zero()};
    const auto read = SensorRigFromYaml(SensorRigToYaml(rig), "rig.yaml");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_TRUE(SameBits(read->robot_from_base, rig.robot_from_base)) << i;
  }
}

TEST(SensorRig, OfAnOlderFileHasNeitherDateNorParent) {
  const auto rig = SensorRigFromYaml(kOldYaml, "old.yaml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->date_utc, "");
  EXPECT_EQ(rig->parent_id, "");
  EXPECT_EQ(rig->camera, DefaultSensorRig().camera);
  EXPECT_EQ(RigId(*rig), RigId(DefaultSensorRig()));
}

/// What reading `yaml` with `what` replaced by `with` complains of.
std::string ComplaintAfter(std::string yaml, const std::string& what, const std::string& with) {
  const std::size_t at = yaml.find(what);
  if (at == std::string::npos) return "not in the file: " + what;
  yaml.replace(at, what.size(), with);
  const auto rig = SensorRigFromYaml(yaml, "rig.yaml");
  return rig ? "none" : rig.error().message;
}

TEST(SensorRig, SaysWhereItsRobotsFrameComesFrom) {
  SensorRig rig = DefaultSensorRig();
  const std::string id = RigId(rig);
  for (const RobotFrameSource source :
       {RobotFrameSource::kUnknown, RobotFrameSource::kCad, RobotFrameSource::kHandEye,
        RobotFrameSource::kSurveyedBoards}) {
    rig.robot_frame_source = source;
    const auto again = SensorRigFromYaml(SensorRigToYaml(rig), "rig.yaml");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->robot_frame_source, source);
    EXPECT_EQ(RigId(*again), id) << "no result depends on it";
  }
  rig.robot_frame_source = RobotFrameSource::kUnknown;
  const auto wrong =
      SensorRigFromYaml(SensorRigToYaml(rig) + "robot_from_base_source: guessed\n", "rig.yaml");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("'guessed' is not cad, hand_eye"), std::string::npos)
      << wrong.error().message;
}

TEST(SensorRig, RefusesAnIdThatIsNotThatOfItsValues) {
  const std::string yaml = SensorRigToYaml(DefaultSensorRig());
  const std::string complaint = ComplaintAfter(yaml, "range_offset_m: 0", "range_offset_m: 0.01");
  EXPECT_NE(complaint.find("rig.yaml:4: the id says " + RigId(DefaultSensorRig())),
            std::string::npos)
      << complaint;
  EXPECT_NE(complaint.find("delete the line with the id"), std::string::npos) << complaint;
  EXPECT_EQ(ComplaintAfter(yaml, "name: \"default\"", "name: \"mine\""), "none");
}

TEST(SensorRig, NamesTheLineOfADateOrAParentThatIsNone) {
  SensorRig rig = DefaultSensorRig();
  rig.date_utc = "2026-03-01T09:30:00Z";
  rig.parent_id = RigId(rig);
  const std::string yaml = SensorRigToYaml(rig);
  const std::string date = ComplaintAfter(yaml, "2026-03-01T", "2026-02-30T");
  EXPECT_NE(date.find("rig.yaml:5: '2026-02-30T09:30:00Z' is not a date"), std::string::npos)
      << date;
  const std::string parent = ComplaintAfter(yaml, "parent: \"", "parent: \"f");
  EXPECT_NE(parent.find("rig.yaml:6: 'f"), std::string::npos) << parent;
  rig.date_utc = "yesterday";
  EXPECT_FALSE(rig.Check());
}

TEST(SensorRig, NamesTheLineAndTheKeyOfAWrongCameraParameter) {
  SensorRig rig = DefaultSensorRig();
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "model: fisheye_k", "model: fisheye"),
            "rig.yaml:6: camera model 'fisheye' is not known; it is fisheye_k, radtan, kb4 or "
            "eucm");
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "k: 0.9413", "k: 9"),
            "rig.yaml:13: camera: k 9 is neither 0 (pinhole) nor in (0.05, 2)");
  rig.camera.lens = RadialTangentialLens(-0.28, 0.07, 2e-4, 1e-5, 0.0);
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "  p2: 1e-05\n", ""),
            "rig.yaml:6: 'p2' is missing");
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "  p2: 1e-05", "  p2: nan"),
            "rig.yaml:16: 'p2' is not a finite number");
  rig.camera.lens = KannalaBrandtLens(0.01, 0.0, 0.0, 0.0);
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "  k4: 0\n", "  k4: 0\n  k5: 0\n"),
            "rig.yaml:17: 'k5' is not known here");
  rig.camera.lens = ExtendedUnifiedLens{0.6, 1.1};
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "alpha: 0.6", "alpha: 1.6"),
            "rig.yaml:13: camera: alpha 1.6 is not in [0, 1]");
  EXPECT_EQ(ComplaintAfter(SensorRigToYaml(rig), "width: 1288", "width: 0"),
            "rig.yaml:7: camera: image size 0 x 964 is not between 1 and 20000");
}

TEST(SensorRig, NamesTheLineOfATypo) {
  std::string yaml = SensorRigToYaml(DefaultSensorRig());
  yaml.replace(yaml.find("  fx:"), 5, "  ffx:");
  const auto rig = SensorRigFromYaml(yaml, "rig.yaml");
  ASSERT_FALSE(rig);
  EXPECT_EQ(rig.error().code, ErrorCode::kBadData);
  EXPECT_NE(rig.error().message.find("rig.yaml:6: 'fx' is missing"), std::string::npos)
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

TEST(SensorRig, RefusesAHeadThatIsKilometresFromItsRobot) {
  SensorRig rig = DefaultSensorRig();
  for (const double height_m : {-1e308, 1001.0, std::numeric_limits<double>::quiet_NaN()}) {
    rig.robot_from_base = {rig.robot_from_base.rotation(), Eigen::Vector3d(0.0, 0.0, height_m)};
    EXPECT_NE(rig.Check().error().message.find("robot_from_base"), std::string::npos) << height_m;
  }
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
