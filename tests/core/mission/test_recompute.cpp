#include "core/mission/recompute.h"

#include <gmock/gmock.h>

#include "core/depth/depth_method.h"
#include "core/mission/new_records.h"
#include "core/registration/register_scan.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Outcome = Recomputed::Outcome;

/// A mission with a scan of a valve, made once: the fit takes a moment.
struct RecomputeTest : testing::Test {
  static inline std::unique_ptr<TemporaryFolder> folder;
  static inline std::unique_ptr<MissionFile> mission;
  static inline Scan scan;
  static inline DepthResult depth;
  static inline DetectionRecord valve;

  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    mission = MissionFile::Create(*folder / "m.foresight").value();
    const Scan scanned = WallAndValveScan({.from_rad = -0.20, .to_rad = 0.20, .speed_rad_s = 0.15});
    const std::int64_t id = mission->BeginScan(scanned).value();
    for (const LidarLine& line : scanned.lines) ASSERT_TRUE(mission->AppendLine(id, line));
    ASSERT_TRUE(mission->AppendMotorSamples(id, scanned.track.samples()));
    for (const CameraFrame& frame : scanned.frames) ASSERT_TRUE(mission->AppendFrame(id, frame));
    ASSERT_TRUE(mission->EndScan(id, ScanState::kComplete, ""));
    scan = scanned;  // in memory, as the window has it
    const RegisteredScan cloud = RegisterScan(scan, {}).value();
    depth = ComputeDepthInFrame(cloud, scan.rig, scan.frames.at(0),
                                DefaultsOf(DepthMethod::kForesight), {})
                .value();
    const auto center =
        scan.rig.camera.Project(scan.rig.CameraFromBase(scan.frames[0].motor_angle_rad) *
                                SyntheticValvePose().translation());
    const Roi roi =
        ImageRoi::Rectangle(scan.frames[0].motor_angle_rad, *center - Eigen::Vector2d(50, 50),
                            *center + Eigen::Vector2d(50, 50));
    const FitOptions options = FitOptionsFor(ObjectKind::kValve, scan.rig.robot_from_base);
    const Detection found =
        FitInScan({scan.rig, cloud, scan.frames, &depth}, FitSource::kDepth, roi, options, {})
            .value();
    valve = NewDetectionRecord(
        scan, found,
        ProvenanceOfFit(scan, FitSource::kDepth, &depth, depth.options.mask, options, roi).value());
    valve.uuid = "valve";
    valve.scan_id = id;
    valve.id = mission->AddDetection(valve).value();
  }
  static void TearDownTestSuite() {
    mission.reset();
    folder.reset();
  }

  static Recomputed Remade(const DetectionRecord& record) {
    return Recomputer(*mission).RemakeDetection(record, {}).value();
  }
  static DetectionRecord With(const std::string& was, const std::string& is, bool provenance) {
    DetectionRecord record = valve;
    std::string& text = provenance ? record.provenance_json : record.json;
    const std::size_t at = text.find(was);
    EXPECT_NE(at, std::string::npos) << was;
    if (at != std::string::npos) text.replace(at, was.size(), is);
    return record;
  }
};

TEST_F(RecomputeTest, AFitOutOfTheFileIsTheSameToTheLastBit) {
  const Recomputed remade = Remade(mission->ListDetections().value().at(0));
  EXPECT_EQ(remade.outcome, Outcome::kSame) << testing::PrintToString(remade.differences);
}

TEST_F(RecomputeTest, ADepthMapIsTheSameToTheLastBit) {
  DepthRecord record = NewDepthRecord(scan, depth, depth.mask, depth.options.mask).value();
  Recomputer recomputer(*mission);
  EXPECT_EQ(recomputer.RemakeDepth(record, {})->outcome, Outcome::kSame);
  record.digest.front() = record.digest.front() == '0' ? '1' : '0';
  const auto other = recomputer.RemakeDepth(record, {});
  EXPECT_EQ(other->outcome, Outcome::kDifferent);
  EXPECT_THAT(other->differences, Contains(HasSubstr("digest: was")));
}

TEST_F(RecomputeTest, AnotherValueIsNamedWithItsPlace) {
  const Recomputed remade = Remade(With(R"("rim_radius_m": 0.)", R"("rim_radius_m": 1.)", false));
  EXPECT_EQ(remade.outcome, Outcome::kDifferent);
  EXPECT_THAT(remade.differences, Contains(HasSubstr("rim_radius_m: was 1.")));
}

TEST_F(RecomputeTest, AnotherOptionGivesAnotherAnswer) {
  const Recomputed remade =
      Remade(With(R"("mask.threshold":0.61)", R"("mask.threshold":0.9)", true));
  EXPECT_EQ(remade.outcome, Outcome::kDifferent);
}

TEST_F(RecomputeTest, WhatCannotBeMadeAgainSaysWhy) {
  DetectionRecord record = valve;
  record.provenance_json.clear();
  EXPECT_THAT(Remade(record).differences, Contains(HasSubstr("no provenance")));
  EXPECT_EQ(Remade(record).outcome, Outcome::kNotPossible);
  EXPECT_THAT(Remade(With(R"("rig_id":")", R"("rig_id":"x)", true)).differences,
              Contains(HasSubstr("made with the rig x")));
  EXPECT_THAT(Remade(With(R"("image_position":0)", R"("image_position":7)", true)).differences,
              Contains(HasSubstr("image 7")));
  record = valve;
  record.scan_uuid = "elsewhere";
  EXPECT_THAT(Remade(record).differences, Contains(HasSubstr("does not hold the scan elsewhere")));
}

TEST_F(RecomputeTest, ProvenanceSurvivesTheRoundTripAndNamesWhatIsWrong) {
  const auto read = ProvenanceFromJson(valve.provenance_json, "x");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(ProvenanceToJson(*read), valve.provenance_json);
  EXPECT_EQ(ProvenanceToJson(*ProvenanceFromJson(ProvenanceToJson({}), "x")), ProvenanceToJson({}));
  EXPECT_THAT(ProvenanceFromJson(R"({"program_version":"1"})", "m: detection 1").error().message,
              testing::AllOf(HasSubstr("m: detection 1: provenance"), HasSubstr("rig_id")));
  for (const char* text : {"", "[1]", R"({"program_version":1})"})
    EXPECT_FALSE(ProvenanceFromJson(text, "x")) << text;
}

}  // namespace
}  // namespace foresight
