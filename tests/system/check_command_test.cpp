// foresightctl check: what scans say about themselves, and what it exits with; evaluate --hold-out.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/utc_text.h"
#include "core/geometry/angles.h"
#include "core/mission/kept_check.h"
#include "core/mission/new_records.h"
#include "core/selfcheck/rig_damage.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/ctl.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;

/// A scan of the shipped scene, up and down.
void ScanScene(const std::string& scene, const std::string& mission, int seed) {
  const ProgramResult scan =
      Ctl({"scan", "--scene",
           std::string(FORESIGHT_SOURCE_DIR) + "/resources/scenes/" + scene + ".yaml", "--passes",
           "2", "--speed", "20", "--seed", std::to_string(seed), "--out", mission});
  ASSERT_EQ(scan.exit_code, 0) << scan.errors;
}

/// Of the room; made once.
const std::string& RoomMission() {
  static const TemporaryFolder kFolder;
  static const std::string kMission = [] {
    const std::string mission = kFolder / "room.foresight";
    ScanScene("room", mission, 4);
    return mission;
  }();
  return kMission;
}

TEST(CheckCommand, AGoodScanSaysSoAndHowGoodItsDepthIs) {
  const ProgramResult result = Ctl({"check", RoomMission(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.output << result.errors;
  const Json scan = Json::parse(result.output)["scans"][0];
  EXPECT_EQ(scan["light"], "good");
  EXPECT_THAT(scan["advice"], StartsWith("nothing to do: "));
  // The beams' noise is 4 to 5 mm at the room's distances.
  EXPECT_GT(scan["depth"]["against_beams"]["q80_m"].get<double>(), 0.005);
  EXPECT_LT(scan["depth"]["against_beams"]["q80_m"].get<double>(), 0.010);
  EXPECT_LT(scan["depth"]["map"]["q80_m"].get<double>(), 0.005);
  EXPECT_GT(scan["depth"]["promise"]["right"].get<double>(), 0.98);
  EXPECT_THAT(scan["cannot_see"].dump(), HasSubstr("motor's zero"));
}

TEST(CheckCommand, SaysOnWhichSideTheEdgesLieAndWhatToDo) {
  const TemporaryFolder folder;
  // The camera that took the image looks 0.4 deg further to the right than this rig knows.
  const SensorRig rig = MissionFile::OpenReadOnly(RoomMission()).value()->LoadScan(1).value().rig;
  ASSERT_TRUE(SaveSensorRig(
      RigBefore({.name = "knocked", .camera_turn_rad = {0.0, RadiansFromDegrees(-0.4), 0.0}}, rig),
      folder / "turned.yaml"));
  const ProgramResult result = Ctl({"check", RoomMission(), "--rig", folder / "turned.yaml"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("px left of the lidar's: check the calibration"));
}

TEST(CheckCommand, ShowsWhatItWouldSayOfAHeadThatWasKnocked) {
  // As if the camera had turned by 0.4 deg to the left since the rig was calibrated.
  const ProgramResult result = Ctl({"check", RoomMission(), "--camera-turned", "0,-0.4,0"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("px left of the lidar's: check the calibration"));
  EXPECT_THAT(result.output, HasSubstr("as if the head had been knocked"));
}

TEST(CheckCommand, WhatDidNotHappenIsNotKept) {
  const ProgramResult result =
      Ctl({"check", RoomMission(), "--camera-turned", "0,0.4,0", "--keep"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("--keep"));
}

TEST(CheckCommand, KeepsTheResultWithTheScanInItsReview) {
  const std::string& mission = RoomMission();
  ASSERT_EQ(Ctl({"check", mission, "--keep"}).exit_code, 0);
  const auto review = MissionFile::FindReviewOf(mission);
  ASSERT_TRUE(review && *review);
  const auto checks = ListScanChecks(**review);
  ASSERT_TRUE(checks) << checks.error().message;
  ASSERT_FALSE(checks->empty());
  const KeptCheck& kept = checks->back();
  EXPECT_EQ(kept.scan_uuid, MissionFile::OpenReadOnly(mission).value()->Summary(1).value().uuid);
  EXPECT_FALSE(kept.author.empty());
  EXPECT_THAT(kept.advice, StartsWith("nothing to do"));
  EXPECT_EQ(Json::parse(kept.answer_json)["depth"]["method"], "foresight");
}

TEST(CheckCommand, AnAcceptedObjectIsFittedInHalves) {
  const TemporaryFolder folder;
  const std::string mission = folder / "valve.foresight";
  ScanScene("valve", mission, 2);
  ASSERT_EQ(
      Ctl({"fit", "valve", mission, "--two-clicks", "560,500,720,500", "--source", "raw", "--save"})
          .exit_code,
      0);
  EXPECT_THAT(Json::parse(Ctl({"check", mission, "--json"}).output)["scans"][0]["objects"],
              IsEmpty())
      << "nobody accepted it yet";
  {
    auto file = MissionFile::Open(mission).value();
    const std::int64_t id = file->ListDetections().value().front().id;
    ASSERT_TRUE(
        file->AddDetectionEvent(id, {NowUtc_ns(), "anna", DetectionEvent::Action::kAccepted, ""}));
    ASSERT_TRUE(file->Close());
  }
  const ProgramResult result = Ctl({"check", mission, "--json"});
  const Json objects = Json::parse(result.output)["scans"][0]["objects"];
  ASSERT_EQ(objects.size(), 1u) << result.errors;
  EXPECT_NE(objects[0]["state"], "not seen") << objects[0].dump();
  ASSERT_FALSE(objects[0]["differences"].empty());
  for (const Json& difference : objects[0]["differences"])
    if (difference["unit"] == "m") {
      EXPECT_LT(std::abs(difference["value"].get<double>()), 0.02) << difference.dump();
    }
}

TEST(CheckCommand, BadDataIsNoVerdict) {
  const TemporaryFolder folder;
  EXPECT_EQ(Ctl({"check", folder / "none.foresight"}).exit_code, 3);
  EXPECT_EQ(Ctl({"check"}).exit_code, 2);
  const ProgramResult missing = Ctl({"check", RoomMission(), "--scan", "7"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.errors, HasSubstr("there is no scan 7"));
}

TEST(EvaluateHoldOut, ComparesMethodsOnTheLinesThatTheyWereNotGiven) {
  const ProgramResult result =
      Ctl({"evaluate", RoomMission(), "--hold-out", "4", "--method", "foresight,jbu", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Json rows = Json::parse(result.output);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["beams"], rows[1]["beams"]);
  // At Foresight's coverage, planes beat averages; docs/evaluation/depth.md has by how much.
  EXPECT_LT(rows[0]["our_mask"]["q95_mm"].get<double>(),
            rows[1]["our_mask"]["q95_mm"].get<double>());
  EXPECT_EQ(rows[0]["our_mask"]["coverage"], rows[1]["our_mask"]["coverage"]);
}

TEST(EvaluateCheck, SaysWhetherAConfidenceMeansWhatItSays) {
  const TemporaryFolder folder;
  const ProgramResult result =
      Ctl({"evaluate-check", "--depth", "--no-rig", "--world", "varied", "--first-seed", "3",
           "--count", "1", "--json", "--chart", folder / "new/chart.svg"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Json classes = Json::parse(result.output).at(0).at("confidence");
  ASSERT_EQ(classes.size(), 10u);
  double pixels = 0.0, right = 0.0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const double of_class = classes[i]["pixels"].get<double>();
    const double promised = classes[i]["promised_sum"].get<double>();
    EXPECT_GE(promised, 0.1 * static_cast<double>(i) * of_class - 1e-6);
    EXPECT_LE(promised, 0.1 * static_cast<double>(i + 1) * of_class + 1e-6);
    EXPECT_LE(classes[i]["right"].get<double>(), of_class);
    pixels += of_class;
    right += classes[i]["right"].get<double>();
  }
  EXPECT_GT(pixels, 100'000.0);
  EXPECT_GT(right, 0.5 * pixels);
  // A point for each class and method of counting, and the two ends of the diagonal.
  const std::string chart = ReadFile(folder / "new/chart.svg").value();
  const auto filled = std::count_if(classes.begin(), classes.end(), [](const Json& of_class) {
    return of_class["pixels"].get<int>() >= 200;
  });
  std::size_t circles = 0;
  for (std::size_t at = 0; (at = chart.find("<circle", at)) != std::string::npos; ++at) ++circles;
  EXPECT_GE(circles, 2u + 2u * static_cast<std::size_t>(filled));
  EXPECT_EQ(Ctl({"evaluate-check", "--world", "mars"}).exit_code, 2);
  EXPECT_EQ(Ctl({"evaluate-check", "--chart", folder / "chart.svg"}).exit_code, 2);
}

TEST(EvaluateCheck, AChartThatCannotBeWrittenIsToldBeforeTheWork) {
  const TemporaryFolder folder;
  const ProgramResult result = Ctl({"evaluate-check", "--depth", "--no-rig", "--first-seed", "3",
                                    "--count", "1", "--chart", folder / ""});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, Not(HasSubstr("scan 1 of 1")));
}

}  // namespace
}  // namespace foresight
