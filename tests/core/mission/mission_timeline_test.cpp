#include "core/mission/mission_timeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Kind = TimelineEntry::Kind;

constexpr std::int64_t kSecond = 1'000'000'000;

/// A mission with two scans, ten seconds apart; the second one was aborted.
class MissionTimelineTest : public testing::Test {
 protected:
  MissionTimelineTest() {
    mission_ = MissionFile::Create(path_).value();
    first_ = SampleScan(1);
    second_ = SampleScan(2);
    second_.start_utc_ns += 10 * kSecond;
    second_.state = ScanState::kAborted;
    second_.reason = "the operator said so";
    first_id_ = Record(*mission_, first_);
    Record(*mission_, second_);
  }

  std::int64_t FirstEnd() const {
    return first_.start_utc_ns + static_cast<std::int64_t>(1e9 * first_.lines.back().time_s);
  }
  std::int64_t AddValve(MissionFile& file, std::int64_t utc_ns, const std::string& uuid) {
    DetectionRecord object;
    object.uuid = uuid;
    object.scan_uuid = first_.uuid;
    if (!file.IsReview()) object.scan_id = first_id_;
    object.kind = "valve";
    object.utc_ns = utc_ns;
    object.author = "anna";
    object.json = "{}";
    return file.AddDetection(object).value();
  }
  MissionTimeline Read(const MissionFile* review = nullptr) const {
    return ReadTimeline(*mission_, review).value();
  }
  static std::vector<Kind> Kinds(const MissionTimeline& timeline) {
    std::vector<Kind> kinds;
    for (const TimelineEntry& entry : timeline.entries) kinds.push_back(entry.kind);
    return kinds;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "m.foresight";
  std::unique_ptr<MissionFile> mission_;
  Scan first_, second_;
  std::int64_t first_id_ = 0;
};

TEST_F(MissionTimelineTest, AScanLastsFromItsFirstLineToItsLastOneWithALostLineBetween) {
  const MissionTimeline timeline = Read();
  ASSERT_THAT(Kinds(timeline), ElementsAre(Kind::kScan, Kind::kCutScan));
  EXPECT_EQ(timeline.entries[0].begin_utc_ns, BeginUtc_ns(first_));
  EXPECT_EQ(timeline.entries[0].end_utc_ns, FirstEnd());
  EXPECT_EQ(timeline.entries[0].scan_uuid, first_.uuid);
  EXPECT_THAT(timeline.entries[1].text, HasSubstr("the operator said so"));
  EXPECT_EQ(timeline.begin_utc_ns, BeginUtc_ns(first_));
  EXPECT_EQ(timeline.end_utc_ns, timeline.entries[1].end_utc_ns);
}

TEST_F(MissionTimelineTest, WhatWasFoundDecidedAndSentStandsInItsLaneInTime) {
  const std::int64_t found = FirstEnd() + kSecond;
  const std::int64_t id = AddValve(*mission_, found, "valve-1");
  using Action = DetectionEvent::Action;
  ASSERT_TRUE(mission_->AddDetectionEvent(id, {found + 1, "ben", Action::kAccepted, ""}));
  ASSERT_TRUE(mission_->AddDetectionEvent(id, {found + 2, "ben", Action::kSent, "accepted"}));
  mission_->AddEvent({0, found + 3, "head", "error", "the motor is stuck", ""}).value();
  mission_->AddEvent({0, found + 4, "head", "info", "homed", ""}).value();
  const MissionTimeline timeline = Read();
  ASSERT_THAT(Kinds(timeline), ElementsAre(Kind::kScan, Kind::kFound, Kind::kAccepted, Kind::kSent,
                                           Kind::kError, Kind::kCutScan))
      << "information is no alarm";
  EXPECT_EQ(timeline.entries[1].lane, TimelineLane::kFits);
  EXPECT_EQ(timeline.entries[2].lane, TimelineLane::kDecisions);
  EXPECT_EQ(timeline.entries[3].lane, TimelineLane::kSends);
  EXPECT_EQ(timeline.entries[4].lane, TimelineLane::kAlarms);
  EXPECT_EQ(timeline.entries[3].object_uuid, "valve-1");
  EXPECT_EQ(timeline.entries[3].text, "valve in scan 1, sent by ben: accepted");
}

TEST_F(MissionTimelineTest, TheLinkIsThereOrLostUntilItChangesAndToTheEnd) {
  const std::int64_t begin = BeginUtc_ns(first_);
  mission_->AddEvent({0, begin, kLinkEventSource, "info", kLinkUpText, ""}).value();
  mission_->AddEvent({0, begin + kSecond, kLinkEventSource, "warning", kLinkLostText, ""}).value();
  const MissionTimeline timeline = Read();
  std::vector<TimelineEntry> link;
  for (const TimelineEntry& entry : timeline.entries)
    if (entry.lane == TimelineLane::kLink) link.push_back(entry);
  ASSERT_EQ(link.size(), 2u);
  EXPECT_EQ(link[0].kind, Kind::kLinkUp);
  EXPECT_EQ(link[0].end_utc_ns, begin + kSecond);
  EXPECT_EQ(link[1].kind, Kind::kLinkLost);
  EXPECT_EQ(link[1].end_utc_ns, timeline.end_utc_ns);
}

TEST_F(MissionTimelineTest, AReviewAddsToItAndMakesTheMissionNoLonger) {
  const std::int64_t found = FirstEnd() + kSecond;
  AddValve(*mission_, found, "valve-1");
  const auto review = MissionFile::OpenReviewOf(path_).value();
  const std::int64_t copy = AddValve(*review, found + 1000 * kSecond, "valve-1");
  ASSERT_TRUE(review->AddDetectionEvent(
      copy, {found + 1001 * kSecond, "cora", DetectionEvent::Action::kRejected, ""}));
  const MissionTimeline without = Read(), with = Read(review.get());
  EXPECT_EQ(with.end_utc_ns, without.end_utc_ns);
  ASSERT_EQ(with.entries.size(), without.entries.size() + 1) << "the valve was found once";
  EXPECT_EQ(with.entries.back().kind, Kind::kRejected);
  EXPECT_TRUE(with.entries.back().in_review);
}

TEST_F(MissionTimelineTest, AScanThatWasSimulatedFasterThanRealTimeEndsWhenItsDepthWasComputed) {
  const std::vector<ScanSummary> scans = mission_->ListScans().value();
  const std::int64_t begin = scans[0].begin_utc_ns, last = begin + 20 * kSecond;
  DepthRecord depth;
  depth.scan_uuid = first_.uuid;
  depth.utc_ns = begin + kSecond;
  const std::int64_t second_last = scans[1].begin_utc_ns + kSecond;
  EXPECT_THAT(ScanEnds(scans, {last, second_last}, {depth}, {}),
              ElementsAre(begin + kSecond, second_last));
  EXPECT_THAT(ScanEnds(scans, {last, second_last}, {}, {}),
              ElementsAre(scans[1].begin_utc_ns, second_last))
      << "or when the next one begins";
  depth.utc_ns = last + kSecond;
  EXPECT_THAT(ScanEnds(scans, {begin + kSecond, second_last}, {depth}, {}),
              ElementsAre(begin + kSecond, second_last))
      << "a depth that came later changes nothing";
}

}  // namespace
}  // namespace foresight
