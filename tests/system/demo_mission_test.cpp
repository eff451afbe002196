// The main job end to end, as packaging/run does it without a display.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

TEST(DemoMission, FindsTheValveOfTheRoomAndWritesAReport) {
  const TemporaryFolder folder;
  const std::string out = folder / "demo";
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"demo", "--scene", kRoomScene, "--out", out, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto json = nlohmann::json::parse(result.output);
  // The bars of the valve scene: 10 mm, 3 deg, the right number of spokes.
  EXPECT_LT(json["center_error_mm"].get<double>(), 10.0);
  EXPECT_LT(json["axis_error_deg"].get<double>(), 3.0);
  EXPECT_TRUE(json["spokes_right"].get<bool>());
  EXPECT_NE(json["verdict"], "UNSURE");
  for (const char* file : {"report.html", "mission.foresight", "image.png", "samples.png",
                           "depth.png", "confidence.png", "masked.png", "cloud.png", "overlay.png",
                           "fit-raw.png", "fit-foresight-alone.png", "fit-paper-alone.png"})
    EXPECT_GT(std::filesystem::file_size(std::filesystem::path(out) / file), 1000u) << file;
  // One file to hand over: nothing is left in a write-ahead log.
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(out) / "mission.foresight-wal"));
}

TEST(DemoMission, ItsMissionFileGivesTheSameFitAgain) {
  const TemporaryFolder folder;
  const std::string mission = folder / "mission.foresight";
  const std::string scene = FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
  ASSERT_EQ(RunProgram(FORESIGHTCTL,
                       {"scan", "--scene", scene, "--from", "-15", "--to", "15", "--out", mission})
                .exit_code,
            0);
  const std::vector<std::string> fit = {"fit",   "valve",           mission,
                                        "--roi", "534,413,721,602", "--json"};
  const ProgramResult first = RunProgram(FORESIGHTCTL, fit);
  const ProgramResult second = RunProgram(FORESIGHTCTL, fit);
  ASSERT_EQ(first.exit_code, 0) << first.errors << first.output;
  auto a = nlohmann::json::parse(first.output);
  auto b = nlohmann::json::parse(second.output);
  a.erase("seconds");
  b.erase("seconds");
  EXPECT_EQ(a, b);
  EXPECT_EQ(a["kind"], "valve");
}

TEST(FitCommand, NoValveIsANegativeAnswerNotAnError) {
  const TemporaryFolder folder;
  const std::string mission = folder / "mission.foresight";
  const std::string scene = FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
  ASSERT_EQ(RunProgram(FORESIGHTCTL, {"scan", "--scene", scene, "--from", "-10", "--to", "10",
                                      "--speed", "20", "--out", mission})
                .exit_code,
            0);
  // A patch of bare bricks.
  const ProgramResult result =
      RunProgram(FORESIGHTCTL, {"fit", "valve", mission, "--roi", "560,320,700,400", "--json"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(result.output)["verdict"], "UNSURE");
}

TEST(ScanCommand, ASecondScanIsAddedToTheMission) {
  const TemporaryFolder folder;
  const std::string mission = folder / "mission.foresight";
  const std::string scene = FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
  const std::vector<std::string> scan = {"scan", "--scene", scene, "--from", "-2",    "--to",
                                         "2",    "--speed", "40",  "--out",  mission, "--json"};
  ASSERT_EQ(RunProgram(FORESIGHTCTL, scan).exit_code, 0);
  const ProgramResult second = RunProgram(FORESIGHTCTL, scan);
  ASSERT_EQ(second.exit_code, 0) << second.errors;
  EXPECT_EQ(nlohmann::json::parse(second.output)["scan"], 2);
}

}  // namespace
}  // namespace foresight
