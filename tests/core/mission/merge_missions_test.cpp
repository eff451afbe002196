#include "core/mission/merge_missions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/diff_missions.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class MergeMissionsTest : public testing::Test {
 protected:
  /// A mission with one scan, one accepted detection and one depth map a seed.
  std::filesystem::path Mission(const std::string& name, const std::vector<std::uint64_t>& seeds) {
    const std::filesystem::path path = folder_ / name;
    const auto mission = MissionFile::Create(path).value();
    for (const std::uint64_t seed : seeds) {
      const std::int64_t id = Record(*mission, SampleScan(seed));
      DetectionRecord detection;
      detection.uuid = "valve of " + std::to_string(seed);
      detection.scan_id = id;
      detection.kind = "valve";
      detection.json = R"({"score":0.9,"seconds":0.1})";
      const std::int64_t found = mission->AddDetection(detection).value();
      EXPECT_TRUE(mission->AddDetectionEvent(
          found, {44, "operator", DetectionEvent::Action::kAccepted, "looks right"}));
      DepthRecord depth;
      depth.uuid = "depth of " + std::to_string(seed);
      depth.scan_id = id;
      depth.digest = "0123";
      mission->AddDepth(depth).value();
    }
    mission->AddEvent({0, 43, "head", "info", "homed", ""}).value();
    EXPECT_TRUE(mission->Close());
    return path;
  }

  Result<MergeReport> Merge(const std::vector<std::filesystem::path>& sources,
                            const MergeOptions& options = {}) {
    return MergeMissions(sources, target_, options, {});
  }

  std::vector<MissionDifference> Diff(const std::filesystem::path& first,
                                      const std::filesystem::path& second) {
    return DiffMissions(*MissionFile::OpenReadOnly(first).value(),
                        *MissionFile::OpenReadOnly(second).value(), {})
        .value();
  }

  TemporaryFolder folder_;
  const std::filesystem::path target_ = folder_ / "merged.foresight";
};

TEST_F(MergeMissionsTest, ADecisionOnAnotherAnswerIsADifference) {
  const auto a = Mission("a.foresight", {1}), b = folder_ / "b.foresight";
  std::filesystem::copy_file(a, b);
  const auto mission = MissionFile::Open(b).value();
  const std::int64_t valve = mission->ListDetections()->at(0).id;
  ASSERT_TRUE(mission->AddDetectionEvent(
      valve, {45, "operator", DetectionEvent::Action::kAccepted, "answer 2"}));
  ASSERT_TRUE(mission->Close());
  const auto differences = Diff(a, b);
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_EQ(differences[0].text, "answer decided on: was 1, is 2");
}

TEST_F(MergeMissionsTest, TwoMissionsBecomeOneAsIfRecordedInOne) {
  const auto a = Mission("a.foresight", {1, 2}), b = Mission("b.foresight", {3});
  const MergeReport report = Merge({a, b}).value();
  EXPECT_EQ(report.scans, 3);
  EXPECT_EQ(report.detections, 3);
  EXPECT_EQ(report.depth_maps, 3);
  EXPECT_EQ(report.events, 1) << "the same line of the log stands once";
  ASSERT_TRUE(MissionFile::OpenReadOnly(target_).value()->Verify({}));
  EXPECT_THAT(Diff(Mission("abc.foresight", {1, 2, 3}), target_), IsEmpty());
}

TEST_F(MergeMissionsTest, AScanThatBothHaveStandsOnce) {
  const auto a = Mission("a.foresight", {1, 2}), b = Mission("b.foresight", {2, 3});
  const MergeReport report = Merge({a, b}).value();
  EXPECT_EQ(report.scans, 3);
  EXPECT_EQ(report.already_there, 1);
  EXPECT_EQ(report.detections, 3);
  EXPECT_EQ(MissionFile::OpenReadOnly(target_).value()->ListDetectionEvents(2).value().size(), 1u);
}

TEST_F(MergeMissionsTest, ADifferentScanUnderTheSameUuidIsRefused) {
  const auto a = Mission("a.foresight", {1});
  const auto other = MissionFile::Create(folder_ / "other.foresight").value();
  Scan shorter = SampleScan(1);
  shorter.lines = SharedList<LidarLine>();
  Record(*other, shorter);
  ASSERT_TRUE(other->Close());
  const auto report = Merge({a, folder_ / "other.foresight"});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(report.error().message, HasSubstr("other.foresight"));
  EXPECT_FALSE(std::filesystem::exists(target_));
}

TEST_F(MergeMissionsTest, OnlyWhatIsKeptIsCopiedWithWhatWasFoundInIt) {
  const auto a = Mission("a.foresight", {1, 2, 3});
  MergeOptions options;
  options.keep = [](const ScanSummary& scan) { return scan.id != 2; };
  const MergeReport report = Merge({a}, options).value();
  EXPECT_EQ(report.scans, 2);
  EXPECT_EQ(report.left_out, 1);
  EXPECT_THAT(Diff(Mission("13.foresight", {1, 3}), target_), IsEmpty());
}

TEST_F(MergeMissionsTest, WhatAReviewHoldsIsMergedIntoItsMission) {
  const auto a = Mission("a.foresight", {1});
  const auto review = MissionFile::OpenReviewOf(a).value();
  DetectionRecord detection;
  detection.uuid = "found later";
  detection.scan_uuid = SampleScan(1).uuid;
  detection.kind = "drill";
  detection.json = "{}";
  review->AddDetection(detection).value();
  const std::filesystem::path review_path = review->path();
  ASSERT_TRUE(review->Close());
  EXPECT_EQ(Merge({review_path, a}).value().detections, 2);
  EXPECT_EQ(MissionFile::OpenReadOnly(target_).value()->ListDetections(1).value().size(), 2u);
}

TEST_F(MergeMissionsTest, ASourceIsNeverTheTarget) {
  const auto a = Mission("a.foresight", {1});
  EXPECT_EQ(MergeMissions(std::vector{a}, a, {}, {}).error().code, ErrorCode::kInvalidInput);
}

TEST_F(MergeMissionsTest, DifferencesAreNamedWithBothValues) {
  const auto a = Mission("a.foresight", {1, 2}), b = Mission("b.foresight", {1});
  const auto changed = MissionFile::Open(b).value();
  ASSERT_TRUE(
      changed->AddDetectionEvent(1, {50, "reviewer", DetectionEvent::Action::kRejected, ""}));
  ASSERT_TRUE(changed->Close());
  std::vector<std::string> texts;
  for (const MissionDifference& difference : Diff(a, b))
    texts.push_back(difference.what + " " + difference.uuid + " " + ToString(difference.kind) +
                    ": " + difference.text);
  EXPECT_THAT(texts,
              testing::UnorderedElementsAre(
                  "scan scan-2 only in the first: ", "detection valve of 2 only in the first: ",
                  "depth map depth of 2 only in the first: ",
                  "detection valve of 1 different: decision: was accepted, is rejected"));
}

}  // namespace
}  // namespace foresight
