// What the checks that were kept with a mission's scans say together.
#include "core/mission/gather_checks.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/geometry/angles.h"
#include "core/mission/rig_check_json.h"
#include "core/selfcheck/gather_rig.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A scan whose edges say that the camera is turned by so much about its y axis.
KeptCheck CheckOf(const std::string& uuid, double turn_deg, std::int64_t utc_ns = 1) {
  Scan scan = SampleScan(1);
  scan.uuid = uuid;
  ScanCheck check;
  check.light = CheckLight::kGood;
  CameraCheck& camera = check.rig.camera.emplace();
  camera.turn_rad = {0.0, RadiansFromDegrees(turn_deg), 0.0};
  camera.covariance = std::pow(RadiansFromDegrees(0.1), 2) * Eigen::Matrix3d::Identity();
  camera.covariance(0, 1) = camera.covariance(1, 0) = 0.1 * camera.covariance(0, 0);
  camera.score = 0.5;
  camera.score_before = 0.4;
  camera.score_aside = 0.1;
  camera.gain_sigmas = 5.0;
  camera.edges = 400;
  camera.images = 2;
  PlateCheck& plate = check.rig.plate.emplace();
  plate.drift.setConstant(1e-4);
  plate.covariance =
      1e-6 * Eigen::Matrix<double, PlateCheck::kUnknowns, PlateCheck::kUnknowns>::Identity();
  plate.covariance(PlateCheck::kStamp, PlateCheck::kStamp) =
      std::numeric_limits<double>::infinity();
  check.rig.passes =
      PassCheck{.stamp_s = 0.0005, .sigma_s = 0.0001, .speed_rad_s = 0.35, .patches = 900};
  TurnCheck& turns = check.rig.turns.emplace();
  turns.drift.setConstant(2e-4);
  turns.covariance =
      1e-6 * Eigen::Matrix<double, TurnCheck::kUnknowns, TurnCheck::kUnknowns>::Identity();
  turns.covariance(TurnCheck::kBend, TurnCheck::kBend) = std::numeric_limits<double>::infinity();
  turns.images = 2;
  turns.points = 1000;
  turns.explained = 0.9;
  plate.planes = 5;
  plate.cells = 300;
  KeptCheck kept = NewKeptCheck(scan, check, {});
  kept.utc_ns = utc_ns;
  return kept;
}

const SensorRig& Rig() {
  static const SensorRig kRig = SampleScan(1).rig;
  return kRig;
}

TEST(GatherChecks, WhatIsMeasuredComesBackBitForBit) {
  const RigCheck& rig = CheckOf("a", 0.123).rig;
  ASSERT_TRUE(rig.camera && rig.plate && rig.turns);
  EXPECT_EQ(rig.turns->drift[TurnCheck::kCameraY], 2e-4);
  EXPECT_EQ(rig.turns->Sigma(TurnCheck::kBend), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(rig.turns->bend_seen);
  ASSERT_TRUE(rig.passes);
  EXPECT_EQ(rig.passes->stamp_s, 0.0005);
  EXPECT_EQ(rig.passes->sigma_s, 0.0001);
  EXPECT_EQ(rig.passes->speed_rad_s, 0.35);
  EXPECT_EQ(rig.passes->patches, 900);
  EXPECT_EQ(rig.turns->images, 2);
  EXPECT_EQ(rig.turns->points, 1000);
  EXPECT_EQ(rig.camera->turn_rad.y(), RadiansFromDegrees(0.123));
  EXPECT_EQ(rig.camera->covariance(0, 1), 0.1 * std::pow(RadiansFromDegrees(0.1), 2));
  EXPECT_EQ(rig.camera->edges, 400);
  EXPECT_EQ(rig.plate->drift[PlateCheck::kTurnZ], 1e-4);
  EXPECT_EQ(rig.plate->Sigma(PlateCheck::kStamp), std::numeric_limits<double>::infinity());
}

TEST(GatherChecks, SeveralScansTellWhatOneDoesNot) {
  std::vector<KeptCheck> checks;
  for (const char* uuid : {"a", "b", "c", "d", "e"}) checks.push_back(CheckOf(uuid, 0.3));
  const RigCheck one = GatherRig(std::vector{checks.front().rig}, Rig(), {});
  EXPECT_FALSE(one.Drifted()) << one.drifted.front();
  const auto gathered = GatherChecks(checks, Rig());
  ASSERT_TRUE(gathered);
  EXPECT_EQ(gathered->scans, 5);
  EXPECT_EQ(gathered->check.light, CheckLight::kAmber);
  EXPECT_THAT(gathered->check.advice, HasSubstr("image edges lie"));
}

TEST(GatherChecks, ADriftThatIsNoNumberBlindsNoOtherScan) {
  std::vector<KeptCheck> checks = {CheckOf("a", 0.0), CheckOf("b", 0.0)};
  auto json = nlohmann::json::parse(RigCheckToJson(checks[0].rig));
  json["turns"]["drift"][0] = nullptr;
  json["plate"]["drift"][1] = nullptr;
  json["camera"]["turn_rad"][1] = nullptr;
  const RigCheck read = RigMeasurementsFromJson(json);
  EXPECT_FALSE(read.turns || read.plate || read.camera);
  checks[0].rig = read;
  checks[1].rig.turns->drift[TurnCheck::kCameraZ] = RadiansFromDegrees(0.5);
  const RigCheck gathered = GatherRig(std::vector{checks[0].rig, checks[1].rig}, Rig(), {});
  ASSERT_TRUE(gathered.turns);
  EXPECT_NEAR(gathered.turns->drift[TurnCheck::kCameraZ], RadiansFromDegrees(0.5), 1e-9);
}

TEST(GatherChecks, BendsOfScansWithOtherImagesAreNotAveraged) {
  std::vector<RigCheck> checks = {CheckOf("a", 0.0).rig, CheckOf("b", 0.0).rig};
  for (RigCheck& check : checks) {
    check.turns->bend_seen = true;
    check.turns->covariance(TurnCheck::kBend, TurnCheck::kBend) = 1e-8;
    check.turns->spread_rad = RadiansFromDegrees(60.0);
    check.turns->drift[TurnCheck::kBend] = 0.001;
  }
  checks[1].turns->spread_rad = RadiansFromDegrees(10.0);
  checks[1].turns->drift[TurnCheck::kBend] = 0.009;
  const RigCheck gathered = GatherRig(checks, Rig(), {});
  ASSERT_TRUE(gathered.turns);
  EXPECT_NEAR(gathered.turns->drift[TurnCheck::kBend], 0.001, 1e-5);
  EXPECT_TRUE(gathered.turns->bend_seen);
}

TEST(GatherChecks, TheNewestCheckOfAScanCountsAndOneScanIsNotSeveral) {
  const std::vector<KeptCheck> checks = {CheckOf("a", 0.9, 1), CheckOf("a", 0.0, 2)};
  EXPECT_FALSE(GatherChecks(checks, Rig()));
  std::vector<KeptCheck> two = checks;
  two.push_back(CheckOf("b", 0.0));
  EXPECT_EQ(GatherChecks(two, Rig())->check.light, CheckLight::kGood);
}

TEST(GatherChecks, ScansOfAnotherRigTakeNoPart) {
  const std::vector<KeptCheck> checks = {CheckOf("a", 0.3), CheckOf("b", 0.3)};
  SensorRig other = Rig();
  other.camera.fx += 1.0;
  EXPECT_FALSE(GatherChecks(checks, other));
}

TEST(GatherChecks, ACheckWithAnotherRigHidesNone) {
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.foresight").value();
  for (const char* uuid : {"a", "b"}) ASSERT_TRUE(AddScanCheck(*mission, CheckOf(uuid, 0.0, 1)));
  KeptCheck tried = CheckOf("a", 0.9, 2);
  auto answer = nlohmann::ordered_json::parse(tried.answer_json);
  answer["rig_id"] = "another";
  tried.answer_json = answer.dump();
  ASSERT_TRUE(AddScanCheck(*mission, tried));
  const auto checks = NewestScanChecks(*mission, nullptr);
  ASSERT_TRUE(checks) << checks.error().message;
  EXPECT_TRUE(GatherChecks(*checks, Rig()));
}

TEST(GatherChecks, TheReasonWhyNothingWasMeasuredIsKept) {
  ScanCheck check;
  check.rig.no_camera = "the scan has no image";
  check.rig.no_plate = "too few planes";
  const KeptCheck kept = NewKeptCheck(SampleScan(1), check, {});
  EXPECT_EQ(kept.rig.no_camera, "the scan has no image");
  EXPECT_EQ(kept.rig.no_plate, "too few planes");
}

TEST(GatherChecks, ChecksOfEarlierProgramsKeptNoMeasurements) {
  KeptCheck kept = CheckOf("a", 0.3);
  auto answer = nlohmann::ordered_json::parse(kept.answer_json);
  for (const char* added : {"turn_rad", "covariance", "outward_px"})
    answer["rig"]["camera"].erase(added);
  for (const char* added : {"drift", "covariance", "speed_rad_s"})
    answer["rig"]["plate"].erase(added);
  kept.answer_json = answer.dump();
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.foresight").value();
  ASSERT_TRUE(AddScanCheck(*mission, kept));
  const auto checks = ListScanChecks(*mission);
  ASSERT_TRUE(checks) << checks.error().message;
  EXPECT_FALSE(checks->front().rig.camera);
  EXPECT_FALSE(checks->front().rig.plate);
}

TEST(GatherChecks, ANumberThatNothingMeasuresIsNamedWithItsEvent) {
  KeptCheck kept = CheckOf("a", 0.3);
  auto answer = nlohmann::ordered_json::parse(kept.answer_json);
  answer["rig"]["camera"]["turn_rad"][1] = 1e300;
  kept.answer_json = answer.dump();
  const TemporaryFolder folder;
  const auto mission = MissionFile::Create(folder / "m.foresight").value();
  ASSERT_TRUE(AddScanCheck(*mission, kept));
  const auto checks = ListScanChecks(*mission);
  ASSERT_FALSE(checks);
  EXPECT_EQ(checks.error().code, ErrorCode::kBadData);
  EXPECT_THAT(checks.error().message, HasSubstr("event 1: self-check: 'turn_rad' holds 1e+300"));
}

}  // namespace
}  // namespace foresight
