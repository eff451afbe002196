#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "core/base/sha256.h"
#include "core/mission/mission_file.h"
#include "core/mission/provenance.h"
#include "core/sensor/rig_id.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Action = DetectionEvent::Action;

class MissionRecords : public testing::Test {
 protected:
  MissionRecords() { scan_id_ = Record(*mission_, SampleScan(1)); }

  DetectionRecord Valve(const std::string& uuid) const {
    DetectionRecord record;
    record.uuid = uuid;
    record.scan_id = scan_id_;
    record.scan_uuid = "scan-1";
    record.kind = "valve";
    record.utc_ns = 42;
    record.author = "operator";
    record.json = R"({"score":0.9})";
    record.provenance_json = R"({"seed":1})";
    return record;
  }

  void Reopen() {
    ASSERT_TRUE(mission_->Close());
    mission_ = MissionFile::Open(path_).value();
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "m.foresight";
  std::unique_ptr<MissionFile> mission_ = MissionFile::Create(path_).value();
  std::int64_t scan_id_ = 0;
};

TEST_F(MissionRecords, ADetectionIsFoundByItsUuid) {
  const std::int64_t id = mission_->AddDetection(Valve("one")).value();
  EXPECT_EQ(mission_->FindDetection("one").value(), id);
  EXPECT_EQ(mission_->FindDetection("two").value(), std::nullopt);
}

TEST_F(MissionRecords, ADetectionComesBackOpenAndUnnamed) {
  DetectionRecord valve = Valve("a");
  valve.id = mission_->AddDetection(valve).value();
  Reopen();
  EXPECT_THAT(mission_->ListDetections().value(), ElementsAre(valve));
  EXPECT_EQ(mission_->ListDetections()->front().decision, Decision::kOpen);
}

TEST_F(MissionRecords, TheSameUuidAgainIsTheSameDetection) {
  const std::int64_t first = mission_->AddDetection(Valve("a")).value();
  EXPECT_NE(mission_->AddDetection(Valve("b")).value(), first);
  Reopen();
  EXPECT_EQ(mission_->AddDetection(Valve("a")).value(), first);
  EXPECT_EQ(mission_->ListDetections()->size(), 2u);
}

TEST_F(MissionRecords, WithoutAUuidEachIsANewOne) {
  EXPECT_NE(mission_->AddDetection(Valve("")).value(), mission_->AddDetection(Valve("")).value());
  EXPECT_EQ(mission_->ListDetections()->at(0).uuid.size(), 36u);
}

TEST_F(MissionRecords, AScanMayBeNamedByItsUuidAlone) {
  DetectionRecord valve = Valve("a");
  valve.scan_id = 0;
  ASSERT_TRUE(mission_->AddDetection(valve));
  EXPECT_EQ(mission_->ListDetections()->at(0).scan_id, scan_id_);
}

TEST_F(MissionRecords, ADetectionNeedsItsScan) {
  DetectionRecord other = Valve("a");
  other.scan_id = 99;
  EXPECT_THAT(mission_->AddDetection(other).error().message, HasSubstr("there is no scan 99"));
  other.scan_id = 0;
  other.scan_uuid = "scan-7";
  EXPECT_THAT(mission_->AddDetection(other).error().message, HasSubstr("there is no scan scan-7"));
  other.scan_id = scan_id_;
  EXPECT_THAT(mission_->AddDetection(other).error().message,
              HasSubstr("scan 1 is scan-1, not scan-7"));
  other.scan_id = 0;
  other.scan_uuid.clear();
  EXPECT_EQ(mission_->AddDetection(other).error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(mission_->ListDetections().value(), IsEmpty());
}

TEST_F(MissionRecords, TheLastDecisionCountsAndAllAreKept) {
  const std::int64_t id = mission_->AddDetection(Valve("a")).value();
  const DetectionEvent accepted{100, "anna", Action::kAccepted, "looks right"};
  const DetectionEvent rejected{200, "bert", Action::kRejected, "the wrong pipe"};
  ASSERT_TRUE(mission_->AddDetectionEvent(id, accepted));
  ASSERT_TRUE(mission_->AddDetectionEvent(id, rejected));
  Reopen();
  const DetectionRecord valve = mission_->ListDetections()->at(0);
  EXPECT_EQ(valve.decision, Decision::kRejected);
  EXPECT_EQ(valve.decided_utc_ns, 200);
  EXPECT_EQ(valve.decided_by, "bert");
  EXPECT_THAT(mission_->ListDetectionEvents(id).value(), ElementsAre(accepted, rejected));
  ASSERT_TRUE(mission_->AddDetectionEvent(id, {300, "anna", Action::kReopened, ""}));
  EXPECT_EQ(mission_->ListDetections()->at(0).decision, Decision::kOpen);
}

TEST_F(MissionRecords, AnObjectThatIsOpenAgainHasNoAnswerThatWasDecidedOn) {
  const std::int64_t id = mission_->AddDetection(Valve("a")).value();
  ASSERT_TRUE(mission_->AddDetectionEvent(id, {1, "anna", Action::kAccepted, "answer 2"}));
  EXPECT_EQ(mission_->ListDetections()->at(0).decided_candidate, 1);
  ASSERT_TRUE(mission_->AddDetectionEvent(id, {2, "anna", Action::kReopened, "answer 2"}));
  EXPECT_EQ(mission_->ListDetections()->at(0).decided_candidate, 0);
}

TEST(DecidedCandidate, IsReadFromTheTextOfADecisionAndNeverNegative) {
  EXPECT_EQ(DecidedCandidateOf("answer 1"), 0);
  EXPECT_EQ(DecidedCandidateOf("answer 3"), 2);
  for (const char* none : {"", "answer", "answer ", "answer 2b", "answer 0", "answer -1",
                           "answer -2147483648", "answer 99999999999", "looks like answer 2"})
    EXPECT_EQ(DecidedCandidateOf(none), 0) << none;
}

TEST_F(MissionRecords, AnEventBelongsToItsDetectionOnly) {
  const std::int64_t a = mission_->AddDetection(Valve("a")).value();
  const std::int64_t b = mission_->AddDetection(Valve("b")).value();
  ASSERT_TRUE(mission_->AddDetectionEvent(b, {1, "anna", Action::kRenamed, "feed valve"}));
  const auto detections = mission_->ListDetections().value();
  EXPECT_EQ(detections[0].id, a);
  EXPECT_EQ(detections[0].name, "");
  EXPECT_EQ(detections[1].name, "feed valve");
  EXPECT_EQ(detections[1].decision, Decision::kOpen);
  EXPECT_THAT(mission_->AddDetectionEvent(99, {}).error().message,
              HasSubstr("there is no detection 99"));
}

TEST_F(MissionRecords, ADeletedDetectionIsKeptAndNotCounted) {
  const std::int64_t a = mission_->AddDetection(Valve("a")).value();
  mission_->AddDetection(Valve("b")).value();
  EXPECT_EQ(mission_->Summary(scan_id_)->objects, 2);
  ASSERT_TRUE(mission_->AddDetectionEvent(a, {1, "anna", Action::kAccepted, ""}));
  ASSERT_TRUE(mission_->AddDetectionEvent(a, {2, "anna", Action::kDeleted, ""}));
  EXPECT_EQ(mission_->Summary(scan_id_)->objects, 1);
  EXPECT_TRUE(mission_->ListDetections()->at(0).deleted);
  EXPECT_EQ(mission_->ListDetections()->at(0).decision, Decision::kAccepted);
  ASSERT_TRUE(mission_->AddDetectionEvent(a, {3, "anna", Action::kRestored, ""}));
  EXPECT_EQ(mission_->ListScans()->at(0).objects, 2);
  EXPECT_FALSE(mission_->ListDetections()->at(0).deleted);
}

TEST_F(MissionRecords, TheDetectionsOfOneScan) {
  const std::int64_t other = Record(*mission_, SampleScan(2));
  mission_->AddDetection(Valve("a")).value();
  DetectionRecord second = Valve("b");
  second.scan_id = other;
  second.scan_uuid.clear();
  mission_->AddDetection(second).value();
  EXPECT_EQ(mission_->ListDetections(other)->size(), 1u);
  EXPECT_EQ(mission_->ListDetections(other)->at(0).scan_uuid, "scan-2");
  EXPECT_EQ(mission_->ListDetections()->size(), 2u);
}

TEST_F(MissionRecords, ADepthMapIsKeptInNumbers) {
  DepthRecord depth;
  depth.uuid = "d";
  depth.scan_id = scan_id_;
  depth.scan_uuid = "scan-1";
  depth.image_position = 1;
  depth.utc_ns = 5;
  depth.author = "operator";
  depth.provenance_json = "{}";
  depth.digest = Sha256Hex("depth");
  depth.statistics = {1000, 10, {0.1, 1.0 / 3.0, 0.5, 0.7, 0.9}, 2.5};
  depth.id = mission_->AddDepth(depth).value();
  EXPECT_EQ(mission_->AddDepth(depth).value(), depth.id);
  Reopen();
  EXPECT_THAT(mission_->ListDepths().value(), ElementsAre(depth));
  EXPECT_THAT(mission_->ListDepths(scan_id_).value(), ElementsAre(depth));
  EXPECT_THAT(mission_->ListDepths(7).value(), IsEmpty());
}

TEST_F(MissionRecords, ADepthMapWithoutAValidPixelHasNoQuantiles) {
  DepthRecord depth;
  depth.scan_id = scan_id_;
  depth.statistics.depth_quantiles_m.fill(std::nan(""));
  ASSERT_TRUE(mission_->AddDepth(depth));
  EXPECT_TRUE(std::isnan(mission_->ListDepths()->at(0).statistics.depth_quantiles_m[2]));
}

TEST_F(MissionRecords, AReaderChangesNothing) {
  const std::int64_t id = mission_->AddDetection(Valve("a")).value();
  const auto reader = MissionFile::OpenReadOnly(path_).value();
  EXPECT_EQ(reader->AddDetection(Valve("b")).error().code, ErrorCode::kState);
  EXPECT_EQ(reader->AddDetectionEvent(id, {}).error().code, ErrorCode::kState);
  EXPECT_EQ(reader->AddDepth({}).error().code, ErrorCode::kState);
}

// What is found in review.

TEST_F(MissionRecords, AReviewLiesBesideItsMissionAndNamesScansByUuid) {
  ASSERT_TRUE(mission_->Close());
  DetectionRecord valve = Valve("a");
  valve.scan_id = 0;
  {
    const auto review = MissionFile::OpenReviewOf(path_).value();
    EXPECT_EQ(review->path(), folder_ / "m.review.foresight");
    EXPECT_TRUE(review->IsReview());
    valve.id = review->AddDetection(valve).value();
    ASSERT_TRUE(review->AddDetectionEvent(valve.id, {7, "anna", Action::kAccepted, ""}));
    DepthRecord depth;
    depth.scan_uuid = "scan-1";
    ASSERT_TRUE(review->AddDepth(depth));
  }
  const auto review = MissionFile::OpenReviewOf(path_).value();
  const auto detections = review->ListDetections().value();
  ASSERT_EQ(detections.size(), 1u);
  EXPECT_EQ(detections[0].scan_id, 0);
  EXPECT_EQ(detections[0].scan_uuid, "scan-1");
  EXPECT_EQ(detections[0].decision, Decision::kAccepted);
  EXPECT_EQ(review->ListDepths()->at(0).scan_uuid, "scan-1");
  EXPECT_TRUE(review->Verify({}));
  EXPECT_FALSE(MissionFile::OpenReadOnly(path_).value()->IsReview());
}

TEST_F(MissionRecords, AReviewDoesNotChangeItsMission) {
  ASSERT_TRUE(mission_->Close());
  const std::string before = Sha256Hex(ReadFile(path_).value());
  const auto review = MissionFile::OpenReviewOf(path_).value();
  DetectionRecord valve = Valve("a");
  valve.scan_id = 0;
  ASSERT_TRUE(review->AddDetection(valve));
  EXPECT_EQ(Sha256Hex(ReadFile(path_).value()), before);
}

TEST_F(MissionRecords, AReviewOfAReviewIsRefused) {
  EXPECT_THAT(MissionFile::OpenReviewOf(folder_ / "m.review.foresight").error().message,
              HasSubstr("is a review itself"));
}

TEST_F(MissionRecords, AMissionUnderTheNameOfAReviewIsNotTakenForOne) {
  MissionFile::Create(folder_ / "n.review.foresight").value().reset();
  EXPECT_THAT(MissionFile::OpenReviewOf(folder_ / "n.foresight").error().message,
              HasSubstr("is a mission, not the review of one"));
}

TEST_F(MissionRecords, TheNameOfAReviewKeepsOtherEndings) {
  EXPECT_EQ(MissionFile::ReviewPathOf(folder_ / "m.mission").value(),
            folder_ / "m.mission.review.foresight");
}

TEST_F(MissionRecords, WhereTheMissionsFolderDoesNotTakeAFileTheGivenOneDoes) {
  // A folder that does not exist takes no file, whoever asks; rights would not stop root.
  const std::filesystem::path nowhere = folder_ / "none" / "m.foresight";
  EXPECT_EQ(MissionFile::ReviewPathOf(nowhere, folder_.path()).value(),
            folder_ / "m.review.foresight");
  EXPECT_THAT(MissionFile::ReviewPathOf(nowhere).error().message, HasSubstr("give a folder"));
}

TEST(RigId, NamesARigByWhatItSays) {
  SensorRig rig = DefaultSensorRig();
  const std::string id = RigId(rig);
  EXPECT_EQ(id.size(), 64u);
  EXPECT_EQ(RigId(SensorRigFromYaml(SensorRigToYaml(rig), "rig").value()), id);
  rig.lidar.range_offset_m = 0.001;
  EXPECT_NE(RigId(rig), id);
}

}  // namespace
}  // namespace foresight
