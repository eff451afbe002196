#include "core/mission/side_result.h"
#include "core/base/utc_text.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/depth/depth_method.h"
#include "core/mission/compare_results.h"
#include "core/mission/merge_missions.h"
#include "core/mission/new_records.h"
#include "core/mission/recompute.h"
#include "core/registration/register_scan.h"
#include "core/sensor/rig_id.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// A mission with a scan of a valve, and two side results: another method, and another rig.
struct SideResultTest : testing::Test {
  static inline std::unique_ptr<TemporaryFolder> folder;
  static inline std::filesystem::path path;
  static inline std::string bytes_before;
  static inline Scan scan;
  static inline std::int64_t scan_id = 0;
  static inline SensorRig other_rig;
  static inline RunAgainAnswer paper_answer;

  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    path = *folder / "m.foresight";
    auto mission = MissionFile::Create(path).value();
    scan = WallAndValveScan({.from_rad = -0.20, .to_rad = 0.20, .speed_rad_s = 0.15});
    scan_id = mission->BeginScan(scan).value();
    for (const LidarLine& line : scan.lines) ASSERT_TRUE(mission->AppendLine(scan_id, line));
    ASSERT_TRUE(mission->AppendMotorSamples(scan_id, scan.track.samples()));
    for (const CameraFrame& frame : scan.frames) ASSERT_TRUE(mission->AppendFrame(scan_id, frame));
    ASSERT_TRUE(mission->EndScan(scan_id, ScanState::kComplete, ""));
    AddValve(*mission);
    ASSERT_TRUE(mission->Close());
    bytes_before = ReadFile(path).value();

    RunAgainSettings paper;
    paper.depth = DefaultsOf(DepthMethod::kPaper);
    paper.depth.mask.threshold = 0.25;
    paper.fit[ObjectKind::kValve]["seed"] = std::uint64_t{7};
    paper_answer = Keep("with the paper's method", paper);
    RunAgainSettings moved;
    moved.depth = DefaultsOf(DepthMethod::kForesight);
    other_rig = scan.rig;
    other_rig.robot_from_base = Rigid<frame::Robot, frame::Base>(
        scan.rig.robot_from_base.rotation(),
        scan.rig.robot_from_base.translation() + Eigen::Vector3d(0.0, 0.0, 0.05));
    moved.rig = other_rig;
    Keep("with the head 50 mm higher", moved);
  }
  static void TearDownTestSuite() { folder.reset(); }

  static void AddValve(MissionFile& mission) {
    const RegisteredScan cloud = RegisterScan(scan, {}).value();
    const CameraFrame& frame = scan.frames.at(0);
    const auto center = scan.rig.camera.Project(scan.rig.CameraFromBase(frame.motor_angle_rad) *
                                                SyntheticValvePose().translation());
    const Roi roi = ImageRoi::Rectangle(frame.motor_angle_rad, *center - Eigen::Vector2d(50, 50),
                                        *center + Eigen::Vector2d(50, 50));
    const FitOptions options = FitOptionsFor(ObjectKind::kValve, scan.rig.robot_from_base);
    const Detection found =
        FitInScan({scan.rig, cloud, scan.frames}, FitSource::kRaw, roi, options, {}).value();
    DetectionRecord record = NewDetectionRecord(
        scan, found, ProvenanceOfFit(scan, FitSource::kRaw, nullptr, {}, options, roi).value());
    record.scan_id = scan_id;
    ASSERT_TRUE(mission.AddDetection(record));
  }

  static RunAgainAnswer Keep(const std::string& name, const RunAgainSettings& settings) {
    const auto mission = MissionFile::OpenReadOnly(path).value();
    const RunAgainAnswer answer =
        RunAgain(scan, mission->ListDetections().value(), settings, {}).value();
    const auto review = MissionFile::OpenReviewOf(path).value();
    EXPECT_TRUE(KeepSideResult(*review, name, scan, settings, answer));
    return answer;
  }
  static std::unique_ptr<MissionFile> Mission() { return MissionFile::OpenReadOnly(path).value(); }
  static std::unique_ptr<MissionFile> Review() { return MissionFile::FindReviewOf(path).value(); }
  static std::vector<SideResult> All() { return ListSideResults(*Review(), scan.uuid).value(); }
  static ResultComparison Compared(const std::string& a, const std::string& b) {
    const auto mission = Mission();
    const auto review = Review();
    const auto make = [&](const std::string& name) {
      return MakeResultAgain(*mission, review.get(), scan_id, name, 0, {}).value();
    };
    return CompareResults(make(a), make(b), {}).value();
  }
};

TEST_F(SideResultTest, TheMissionStaysAsItIsToTheLastByte) {
  EXPECT_EQ(ReadFile(path).value(), bytes_before);
}

TEST_F(SideResultTest, IsRenamedAndDeletedAndBroughtBackWithoutAWordBeingOverwritten) {
  const std::vector<SideResult> before = All();
  const auto change = [](const auto& body) {
    const auto review = MissionFile::OpenReviewOf(path).value();
    ASSERT_TRUE(body(*review));
  };
  change([&](MissionFile& review) { return RenameSideResult(review, before[0].uuid, "other"); });
  EXPECT_EQ(All()[0].name, "other");
  EXPECT_EQ(All()[0].answer_json, before[0].answer_json);
  change([&](MissionFile& review) { return DeleteSideResult(review, before[0].uuid); });
  ASSERT_EQ(All().size(), 1u);
  EXPECT_EQ(All()[0].uuid, before[1].uuid);
  // What it found is no finding of the scan for that.
  EXPECT_EQ(DetectionsOfScan(*Mission(), Review().get(), scan.uuid)->size(), 1u);
  change([&](MissionFile& review) { return RestoreSideResult(review, before[0].uuid); });
  change([&](MissionFile& review) {
    return RenameSideResult(review, before[0].uuid, before[0].name);
  });
  ASSERT_EQ(All().size(), 2u);
  EXPECT_EQ(All()[0].name, before[0].name);
  EXPECT_FALSE(RenameSideResult(*MissionFile::OpenReviewOf(path).value(), before[0].uuid, ""));
}

TEST_F(SideResultTest, IsListedWithNameAuthorTimeAndItsWholeAnswer) {
  const std::vector<SideResult> all = All();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "with the paper's method");
  EXPECT_EQ(all[0].author, OperatorName());
  EXPECT_NEAR(static_cast<double>(all[0].utc_ns), static_cast<double>(NowUtc_ns()), 120e9);
  EXPECT_EQ(all[0].answer_json, paper_answer.json);
  EXPECT_EQ(all[0].depth.method, DepthMethod::kPaper);
  EXPECT_FALSE(all[0].other_rig);
  EXPECT_EQ(all[0].depth_uuids.size(), scan.frames.size());
  EXPECT_EQ(all[0].detection_uuids.size(), 1u);
  EXPECT_TRUE(all[1].other_rig);
  EXPECT_EQ(all[1].rig_id, RigId(other_rig));
}

TEST_F(SideResultTest, WhatDiffersIsToldInWords) {
  const DepthOptions original = OriginalDepthOptions(*Mission(), scan_id, 0).value();
  const auto paper = DifferencesInWords(All()[0], original, scan.rig);
  EXPECT_THAT(paper, Contains("method paper instead of foresight"));
  EXPECT_THAT(paper, Contains(HasSubstr("0.25 instead of 0.35")));
  EXPECT_THAT(paper, Contains("valve: Seed 7"));
  EXPECT_THAT(DifferencesInWords(All()[1], original, scan.rig),
              ElementsAre("rig " + ShortRigId(other_rig) + " instead of " + ShortRigId(scan.rig)));
}

TEST_F(SideResultTest, EveryRecordIsMadeAgainToTheLastBitAlsoWithAnotherRig) {
  const auto mission = Mission();
  const auto review = Review();
  Recomputer recomputer(*mission, review.get());
  const auto depths = review->ListDepths().value();
  EXPECT_EQ(depths.size(), 2 * scan.frames.size());
  for (const DepthRecord& record : depths)
    EXPECT_EQ(recomputer.RemakeDepth(record, {})->outcome, Recomputed::Outcome::kSame);
  const auto fits = review->ListDetections().value();
  EXPECT_EQ(fits.size(), 2u);
  for (const DetectionRecord& record : fits) {
    const Recomputed remade = recomputer.RemakeDetection(record, {}).value();
    EXPECT_EQ(remade.outcome, Recomputed::Outcome::kSame)
        << testing::PrintToString(remade.differences);
  }
  // Without the file that keeps the rig it says so, and nothing is compared with the wrong one.
  Recomputer without_rigs(*mission);
  EXPECT_EQ(without_rigs.RemakeDepth(depths.back(), {})->outcome,
            Recomputed::Outcome::kNotPossible);
}

TEST_F(SideResultTest, ItsFitsAreNoFindingsOfTheScan) {
  EXPECT_EQ(DetectionsOfScan(*Mission(), Review().get(), scan.uuid)->size(), 1u);
}

TEST_F(SideResultTest, AResultComparedWithItselfDiffersInNothing) {
  const ResultComparison same = Compared(kOriginalResult, kOriginalResult);
  ASSERT_TRUE(same.depth && same.lidar && same.masked);
  EXPECT_GT(same.depth->in_both, 1000);
  EXPECT_EQ(same.depth->only_in_first + same.depth->only_in_second, 0);
  EXPECT_EQ(same.depth->max_abs_m, 0.0);
  EXPECT_EQ(same.lidar->from_first.max_m, 0.0);
  EXPECT_EQ(same.masked->from_second.max_m, 0.0);
  ASSERT_EQ(same.objects.size(), 1u);
  EXPECT_EQ(same.objects[0].difference->distance_m, 0.0);
}

TEST_F(SideResultTest, AHeadThatIsHigherMovesCloudsAndObjectsByAsMuch) {
  const ResultComparison moved = Compared(kOriginalResult, "with the head 50 mm higher");
  EXPECT_EQ(moved.depth->max_abs_m, 0.0);  // the camera sees the same depth
  // Along the wall a point finds another neighbour; seen from the edge it is 50 mm.
  EXPECT_NEAR(moved.lidar->from_first.max_m, 0.05, 0.002);
  ASSERT_EQ(moved.objects.size(), 1u);
  ASSERT_TRUE(moved.objects[0].difference);
  EXPECT_NEAR(moved.objects[0].difference->distance_m, 0.05, 1e-6);
  EXPECT_NEAR(moved.objects[0].difference->angle_rad, 0.0, 1e-6);
  EXPECT_TRUE(moved.notes.empty()) << moved.notes.front();
}

TEST_F(SideResultTest, AnotherMethodGivesOtherDepthsAndTheJsonHasTheNumbers) {
  const ResultComparison compared = Compared(kOriginalResult, "with the paper's method");
  EXPECT_GT(compared.depth->max_abs_m, 0.0);
  EXPECT_EQ(compared.lidar->from_first.max_m, 0.0);  // the same returns
  const auto json = nlohmann::json::parse(ComparisonToJson(compared));
  EXPECT_EQ(json.at("depth").at("in_both"), compared.depth->in_both);
  EXPECT_EQ(json.at("depth").at("median_abs_m"), compared.depth->median_abs_m);
  EXPECT_EQ(json.at("masked_depth").at("from_first").at("p95_m"),
            compared.masked->from_first.p95_m);
  EXPECT_EQ(json.at("objects").size(), 1u);
  EXPECT_EQ(ComparisonToJson(compared),
            ComparisonToJson(Compared(kOriginalResult, "with the paper's method")));
}

TEST_F(SideResultTest, AResultIsFoundByItsUuidAndAnUnknownNameIsAnsweredWithThoseThereAre) {
  const auto mission = Mission();
  const auto review = Review();
  const auto by_uuid =
      MakeResultAgain(*mission, review.get(), scan_id, All()[0].uuid.substr(0, 8), 0, {});
  ASSERT_TRUE(by_uuid) << by_uuid.error().message;
  EXPECT_EQ(by_uuid->name, "with the paper's method");
  const auto unknown = MakeResultAgain(*mission, review.get(), scan_id, "nothing", 0, {});
  EXPECT_EQ(unknown.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(unknown.error().message, HasSubstr("original, with the paper's method"));
  EXPECT_EQ(MakeResultAgain(*mission, review.get(), scan_id, kOriginalResult, 99, {}).error().code,
            ErrorCode::kInvalidInput);
}

TEST_F(SideResultTest, TwoScansThatAreComparedAreSaidToBeInFramesOfTheirOwn) {
  ComparedResult first =
      MakeResultAgain(*Mission(), nullptr, scan_id, kOriginalResult, 0, {}).value();
  ComparedResult second = first;
  EXPECT_THAT(CompareResults(first, second, {})->notes, testing::IsEmpty());
  second.scan_uuid = "another";
  const ResultComparison compared = CompareResults(first, second, {}).value();
  ASSERT_EQ(compared.notes.size(), 1u);
  EXPECT_THAT(compared.notes[0], HasSubstr("each counts in its own robot's frame"));
  EXPECT_THAT(ComparisonInWords(compared).back(), HasSubstr("own robot's frame"));
}

TEST_F(SideResultTest, AMergedMissionKeepsSideResultsAndTheirRigs) {
  const std::filesystem::path merged = *folder / "merged.foresight";
  const std::vector<std::filesystem::path> sources = {path, *MissionFile::ReviewPathOf(path)};
  ASSERT_TRUE(MergeMissions(sources, merged, {}, {}));
  const auto mission = MissionFile::OpenReadOnly(merged).value();
  EXPECT_EQ(ListSideResults(*mission, scan.uuid)->size(), 2u);
  EXPECT_EQ(DetectionsOfScan(*mission, nullptr, scan.uuid)->size(), 1u);
  const std::int64_t id = mission->FindScan(scan.uuid)->value();
  const auto moved = MakeResultAgain(*mission, nullptr, id, "with the head 50 mm higher", 0, {});
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(RigId(moved->rig), RigId(other_rig));
  EXPECT_EQ(OriginalDepthOptions(*mission, id, 0)->method, DepthMethod::kForesight);
}

TEST_F(SideResultTest, AnEventThatIsDamagedIsNamedAndAnEmptyNameIsRefused) {
  const TemporaryFolder other;
  const auto file = MissionFile::Create(other / "m.foresight").value();
  ASSERT_TRUE(file->AddEvent({0, 1, "side result", "info", "x", R"({"format":1})"}));
  const auto listed = ListSideResults(*file);
  EXPECT_EQ(listed.error().code, ErrorCode::kBadData);
  EXPECT_THAT(listed.error().message, HasSubstr("event 1: side result"));
  EXPECT_EQ(KeepSideResult(*file, "", scan, {}, {}).error().code, ErrorCode::kInvalidInput);
}

TEST_F(SideResultTest, AnOptionThatAFitDoesNotHaveIsNamed) {
  EXPECT_THAT(CheckFitOption(ObjectKind::kValve, "x", 1.0).error().message,
              HasSubstr("no option 'x'"));
}

}  // namespace
}  // namespace foresight
