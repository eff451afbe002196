// foresightctl rig: which calibration a file holds.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/sensor/rig_id.h"
#include "core/sensor/sensor_rig.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class RigCommand : public testing::Test {
 protected:
  RigCommand() {
    rig_.name = "head 7";
    rig_.date_utc = "2026-03-01T09:30:00Z";
    rig_.parent_id = RigId(DefaultSensorRig());
    rig_.camera.lens = KannalaBrandtLens(-0.0127, 0.0201, -0.0124, 0.0017);
  }
  ProgramResult Show(const std::string& yaml, const std::vector<std::string>& more = {}) {
    EXPECT_TRUE(WriteFileAtomically(file_, yaml));
    std::vector<std::string> arguments = {"rig", "show", file_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(FORESIGHTCTL, arguments);
  }

  TemporaryFolder folder_;
  std::string file_ = folder_ / "rig.yaml";
  SensorRig rig_ = DefaultSensorRig();
};

TEST_F(RigCommand, SaysModelIdDateParentAndMainValues) {
  const ProgramResult result = Show(SensorRigToYaml(rig_));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("head 7, " + ShortRigId(rig_)));
  EXPECT_THAT(result.output, HasSubstr(RigId(rig_)));
  EXPECT_THAT(result.output, HasSubstr("2026-03-01T09:30:00Z"));
  EXPECT_THAT(result.output, HasSubstr(RigId(DefaultSensorRig())));
  EXPECT_THAT(result.output, HasSubstr("Kannala-Brandt (KB4) (kb4)"));
  EXPECT_THAT(result.output, HasSubstr("1288 x 964 px"));
  EXPECT_THAT(result.output, HasSubstr("k3 -0.0124"));
  EXPECT_THAT(result.output, HasSubstr("1081 beams every 0.250 deg"));
}

TEST_F(RigCommand, AsJsonGivesEveryValueAsItIs) {
  const ProgramResult result = Show(SensorRigToYaml(rig_), {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json["name"], "head 7");
  EXPECT_EQ(json["id"], RigId(rig_));
  EXPECT_EQ(json["date"], rig_.date_utc);
  EXPECT_EQ(json["parent"], rig_.parent_id);
  EXPECT_EQ(json["camera"]["model"], "kb4");
  EXPECT_EQ(json["camera"]["fx"], 601.0);
  EXPECT_EQ(json["camera"]["k4"], 0.0017);
  EXPECT_EQ(json["lidar"]["beams"], 1081);
  EXPECT_EQ(json["camera_from_head"]["translation_m"][1], 0.035);
  EXPECT_EQ(json["angle_correction"].size(), 0u);
}

TEST_F(RigCommand, SaysThePapersFieldOfView) {
  const ProgramResult result = Show(SensorRigToYaml(DefaultSensorRig()), {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_TRUE(json["date"].is_null());
  EXPECT_TRUE(json["parent"].is_null());
  // Section III prints 118.6 x 90.0 deg; f = 601 px is rounded.
  EXPECT_NEAR(json["camera"]["field_of_view_deg"][0].get<double>(), 118.6, 0.1);
  EXPECT_NEAR(json["camera"]["field_of_view_deg"][1].get<double>(), 90.0, 0.1);
}

TEST_F(RigCommand, AnEdgeThatTheLensDoesNotShowHasNoAngle) {
  rig_.camera.lens = RadialTangentialLens(-0.3, 0.0, 0.0, 0.0, 0.0);
  const auto json = nlohmann::json::parse(Show(SensorRigToYaml(rig_), {"--json"}).output);
  EXPECT_TRUE(json["camera"]["field_of_view_deg"][0].is_null());
  EXPECT_THAT(Show(SensorRigToYaml(rig_)).output, HasSubstr("beyond the lens"));
}

TEST_F(RigCommand, RefusesAFileWhoseValuesWereChangedAfterItsIdWasWritten) {
  std::string yaml = SensorRigToYaml(rig_);
  yaml.replace(yaml.find("fx: 601"), 7, "fx: 602");
  const ProgramResult result = Show(yaml);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(result.output.empty()) << result.output;
  EXPECT_THAT(result.errors, HasSubstr("rig.yaml:4: the id says " + RigId(rig_)));
}

TEST_F(RigCommand, AFileThatIsNotThereIsBadDataAndNoFileAUsageError) {
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"rig", "show", folder_ / "none.yaml"}).exit_code, 3);
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"rig", "show"}).exit_code, 2);
  EXPECT_EQ(RunProgram(FORESIGHTCTL, {"rig"}).exit_code, 2);
}

TEST_F(RigCommand, ComparesTwoRigsInWhatDoesNotDependOnTheGauge) {
  const std::string other_file = folder_ / "other.yaml";
  SensorRig other = rig_;
  other.camera.cx += 0.5;
  other.lidar.stamp_offset_s += 0.002;
  // Along the motor's axis, where the head's origin is a choice.
  const Eigen::Vector3d along = rig_.camera_from_head.Rotate(Eigen::Vector3d::UnitX());
  other.camera_from_head = {rig_.camera_from_head.rotation(),
                            rig_.camera_from_head.translation() + 0.1 * along};
  ASSERT_TRUE(SaveSensorRig(rig_, file_));
  ASSERT_TRUE(SaveSensorRig(other, other_file));
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"rig", "compare", file_, other_file, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_NEAR(json["camera_rms_px"].get<double>(), 0.5, 1e-6);
  EXPECT_NEAR(json["axis_mm"].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(json["axis_deg"].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(json["stamp_offset_ms"].get<double>(), -2.0, 1e-6);

  other.camera.width += 2;
  ASSERT_TRUE(SaveSensorRig(other, other_file));
  const ProgramResult wrong = RunProgram(FORESIGHTCTL, {"rig", "compare", file_, other_file});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.errors, HasSubstr("different heads"));
}

}  // namespace
}  // namespace foresight
