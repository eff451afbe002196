// foresightctl calibrate check, calibrate robot and rig set-robot-frame: what they say and exit
// with.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "core/mission/mission_file.h"
#include "core/selfcheck/rig_damage.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A scan of the shipped room, up and down; made once.
const std::string& RoomMission() {
  static const TemporaryFolder kFolder;
  static const std::string kMission = [] {
    const std::string mission = kFolder / "room.foresight";
    const ProgramResult scan =
        Ctl({"scan", "--scene", std::string(FORESIGHT_SOURCE_DIR) + "/resources/scenes/room.yaml",
             "--passes", "2", "--speed", "20", "--seed", "4", "--out", mission});
    EXPECT_EQ(scan.exit_code, 0) << scan.errors;
    return mission;
  }();
  return kMission;
}

SensorRig RigOfRoom() {
  return MissionFile::OpenReadOnly(RoomMission()).value()->LoadScan(1).value().rig;
}

TEST(CalibrateCheckCommand, IsQuietAboutTheRigOfAFreshScan) {
  const ProgramResult result = Ctl({"calibrate", "check", RoomMission()});
  EXPECT_EQ(result.exit_code, 0) << result.output << result.errors;
  EXPECT_THAT(result.output, HasSubstr("fine "));
  EXPECT_THAT(result.output, HasSubstr("motor's zero"));
  EXPECT_THAT(result.output, testing::Not(HasSubstr("drifted")));
}

TEST(CalibrateCheckCommand, NamesACameraThatTurned) {
  const TemporaryFolder folder;
  const SensorRig rig = RigBefore(
      {.name = "knocked", .camera_turn_rad = {0.0, RadiansFromDegrees(-0.4), 0.0}}, RigOfRoom());
  ASSERT_TRUE(SaveSensorRig(rig, folder / "turned.yaml"));
  const ProgramResult result =
      Ctl({"calibrate", "check", RoomMission(), "--rig", folder / "turned.yaml", "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_FALSE(json["fine"].get<bool>());
  EXPECT_EQ(json["findings"][1]["name"], "camera turn y");
  EXPECT_EQ(json["findings"][1]["state"], "drifted");
  EXPECT_NEAR(std::abs(json["findings"][1]["value"].get<double>()), RadiansFromDegrees(0.4),
              RadiansFromDegrees(0.1));
}

TEST(CalibrateCheckCommand, BadDataIsNoVerdict) {
  const TemporaryFolder folder;
  EXPECT_EQ(Ctl({"calibrate", "check", folder / "none.foresight"}).exit_code, 3);
  const ProgramResult empty = Ctl({"calibrate", "check", folder.path()});
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.errors, HasSubstr("session.yaml"));
  EXPECT_EQ(Ctl({"calibrate", "check"}).exit_code, 2);
}

TEST(CalibrateCheckCommand, RatesARigOnASessionOfBoards) {
  const TemporaryFolder folder;
  const std::string session = folder / "session";
  ASSERT_EQ(Ctl({"simulate", "calibration", session, "--poses", "4", "--views", "0"}).exit_code, 0);
  const ProgramResult good = Ctl({"calibrate", "check", session, "--rig", session + "/truth.yaml"});
  EXPECT_EQ(good.exit_code, 0) << good.output << good.errors;
  // The session's own rig is the CAD's, 5 deg off.
  const ProgramResult cad = Ctl({"calibrate", "check", session});
  EXPECT_EQ(cad.exit_code, 1) << cad.errors;
  EXPECT_THAT(cad.output, HasSubstr("lidar against the camera"));
}

TEST(CalibrateRobotCommand, WritesARigWithTheRobotsFrame) {
  const TemporaryFolder folder;
  ASSERT_TRUE(SaveSensorRig(DefaultSensorRig(), folder / "rig.yaml"));
  ASSERT_TRUE(WriteFileAtomically(
      folder / "robot.yaml",
      "foresight_robot_frame: 1\nboards: surveyed\nsamples:\n"
      "  - {robot_from_board: {quaternion_wxyz: [1, 0, 0, 0], translation_m: [1, 2, 3]},\n"
      "     base_from_board: {quaternion_wxyz: [1, 0, 0, 0], translation_m: [0, 0, 1]}}\n"));
  const ProgramResult result = Ctl({"calibrate", "robot", folder / "robot.yaml", "--rig",
                                    folder / "rig.yaml", "--out", folder / "new.yaml"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rig = LoadSensorRig(folder / "new.yaml");
  ASSERT_TRUE(rig);
  EXPECT_LT((rig->robot_from_base.translation() - Eigen::Vector3d(1.0, 2.0, 2.0)).norm(), 1e-9);
  EXPECT_THAT(Ctl({"rig", "show", folder / "new.yaml"}).output, HasSubstr("surveyed places"));
}

TEST(RigSetRobotFrame, IsTypedFromCadAndSaysSo) {
  const TemporaryFolder folder;
  ASSERT_TRUE(SaveSensorRig(DefaultSensorRig(), folder / "rig.yaml"));
  const std::vector<std::string> typed = {"rig",         "set-robot-frame",   folder / "rig.yaml",
                                          "--out",       folder / "new.yaml", "--position",
                                          "0.1,-0.2,1.4"};
  auto with_turn = typed;
  with_turn.insert(with_turn.end(), {"--rpy", "-90,0,-90"});
  ASSERT_EQ(Ctl(with_turn).exit_code, 0) << Ctl(with_turn).errors;
  const auto rig = LoadSensorRig(folder / "new.yaml");
  ASSERT_TRUE(rig);
  // Base's z looks along the robot's x, its x to the robot's right.
  EXPECT_LT(
      (rig->robot_from_base.Rotate(Eigen::Vector3d::UnitZ()) - Eigen::Vector3d::UnitX()).norm(),
      1e-9);
  EXPECT_LT(
      (rig->robot_from_base.Rotate(Eigen::Vector3d::UnitX()) + Eigen::Vector3d::UnitY()).norm(),
      1e-9);
  EXPECT_THAT(Ctl({"rig", "show", folder / "new.yaml"}).output, HasSubstr("typed from CAD"));
  EXPECT_EQ(Ctl(typed).exit_code, 2) << "a turn is needed";
}

}  // namespace
}  // namespace foresight
