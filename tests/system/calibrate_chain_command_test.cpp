// foresightctl simulate calibration and calibrate motor, lidar, time, all: from a folder to a rig.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/calibration/compare_rigs.h"
#include "core/evaluation/simulate_calibration.h"
#include "core/geometry/angles.h"
#include "core/simulation/world.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class CalibrateChainCommand : public testing::Test {
 protected:
  std::string Simulate(const std::vector<std::string>& more = {}) {
    std::string folder = folder_ / "session";
    std::vector<std::string> arguments = {"simulate", "calibration", folder, "--seed", "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult made = RunProgram(FORESIGHTCTL, arguments);
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    return folder;
  }
  RigError ErrorOf(const std::string& rig, const std::string& session) {
    const auto found = LoadSensorRig(rig);
    const auto truth = LoadSensorRig(session + "/truth.yaml");
    EXPECT_TRUE(found && truth);
    return found && truth ? CompareRigs(*found, *truth).value() : RigError();
  }

  TemporaryFolder folder_;
};

// A head that is emulated in the scene turns its plate as its own motor does.
TEST_F(CalibrateChainCommand, TheTruthOfASceneHasTheAnglesOfTheHeadThatRecordsThere) {
  const std::string room = Simulate({"--scene"});
  auto scene = LoadScene(room + "/scene.yaml");
  const auto truth = LoadSensorRig(room + "/truth.yaml");
  ASSERT_TRUE(scene && truth);
  const World world(std::make_shared<const Scene>(std::move(*scene)), *truth, {});
  for (const auto& knot : truth->angle_correction.knots())
    EXPECT_NEAR(knot.plate_rad,
                world.PlateAngle(knot.motor_rad, true) - world.PlateAngle(0.0, true), 1e-9);
}

TEST_F(CalibrateChainCommand, AllWritesARigCloseToTheTruthWithItsDeviations) {
  const std::string session = Simulate();
  const std::string rig = folder_ / "rig.yaml", page = folder_ / "page";
  const ProgramResult result = RunProgram(
      FORESIGHTCTL, {"calibrate", "all", session, "--json", "--out", rig, "--report", page});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const RigError error = ErrorOf(rig, session);
  EXPECT_LT(DegreesFromRadians(error.axis_rad), 0.06);
  EXPECT_LT(1000.0 * error.axis_m, 0.8);
  EXPECT_LT(DegreesFromRadians(error.lidar_rad), 0.2);
  EXPECT_LT(1000.0 * error.lidar_m, 3.0);
  EXPECT_LT(1000.0 * std::abs(error.stamp_offset_s), 1.0);
  const auto json = nlohmann::json::parse(result.output);
  EXPECT_NEAR(json["reduced_chi_square"].get<double>(), 1.0, 0.05);
  EXPECT_EQ(json["angles"].size(), 12u);
  // 5 of the camera, 4 of the axis, 11 angles, 6 of board B, 6 of the lidar and 2 offsets.
  EXPECT_EQ(json["sigma"].size(), 34u);
  EXPECT_FALSE(json["weakest"].get<std::string>().empty());
  const auto html = ReadFile(page + "/report.html");
  ASSERT_TRUE(html);
  EXPECT_THAT(*html, HasSubstr("Reduced chi-square"));
  EXPECT_THAT(*html, HasSubstr("<svg"));
}

TEST_F(CalibrateChainCommand, ThePapersSequenceStandsBesideOursInEveryForm) {
  const std::string session = Simulate({"--poses", "4", "--scans", "20"});
  const std::string page = folder_ / "page";
  const ProgramResult result = RunProgram(
      FORESIGHTCTL, {"calibrate", "all", session, "--compare-paper", "--json", "--report", page});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  bool has_lidar = false;
  for (const auto& value : json["beside_the_paper"])
    has_lidar = has_lidar || (value["name"] == "place of the lidar" && value["paper"] > 0.0);
  EXPECT_TRUE(has_lidar);
  EXPECT_THAT(ReadFile(page + "/report.html").value(), HasSubstr("Beside the paper"));
  EXPECT_THAT(ReadFile(page + "/report.pdf").value(), testing::StartsWith("%PDF"));
  const ProgramResult both =
      RunProgram(FORESIGHTCTL, {"calibrate", "all", session, "--compare-paper", "--paper"});
  EXPECT_EQ(both.exit_code, 2);
}

TEST_F(CalibrateChainCommand, MotorAloneNeedsNoLidar) {
  const std::string session = Simulate({"--scans", "0", "--sweeps", "0"});
  const ProgramResult result = RunProgram(FORESIGHTCTL, {"calibrate", "motor", session});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("plate angle at 80 deg"));
  const ProgramResult lidar = RunProgram(FORESIGHTCTL, {"calibrate", "lidar", session});
  EXPECT_EQ(lidar.exit_code, 1);
  EXPECT_THAT(lidar.errors,
              HasSubstr(session + ": camera and lidar: the session has no lidar lines"));
}

TEST_F(CalibrateChainCommand, TimeRefusesASweepThatGoesOneWay) {
  const std::string session = Simulate({"--one-way"});
  const ProgramResult result = RunProgram(FORESIGHTCTL, {"calibrate", "time", session, "--json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, HasSubstr("goes up only"));
}

TEST_F(CalibrateChainCommand, AFolderWithoutASessionIsNamed) {
  const ProgramResult result = RunProgram(FORESIGHTCTL, {"calibrate", "all", folder_.path()});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, HasSubstr("session.yaml"));
}

TEST_F(CalibrateChainCommand, IntrinsicImagesAreLookedAtForTheBoard) {
  // Few, for some seconds' work: three poses, three stops.
  const std::string session =
      Simulate({"--images", "--views", "8", "--poses", "3", "--first-stop", "0", "--last-stop",
                "40", "--stop-step", "20", "--scans", "0", "--sweeps", "0"});
  const std::string rig = folder_ / "rig.yaml";
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"calibrate", "motor", session, "--out", rig});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const RigError error = ErrorOf(rig, session);
  EXPECT_LT(DegreesFromRadians(error.axis_rad), 0.1);
  EXPECT_LT(1000.0 * error.axis_m, 2.0);
}

}  // namespace
}  // namespace foresight
