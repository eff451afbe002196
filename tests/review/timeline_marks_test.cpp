#include "ui/viewmodels/timeline_marks.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

constexpr std::int64_t kMarksSecond = 1'000'000'000;

TimelineEntry Moment(TimelineLane lane, std::int64_t utc_ns) {
  TimelineEntry entry;
  entry.lane = lane;
  entry.begin_utc_ns = entry.end_utc_ns = utc_ns;
  return entry;
}

/// A scan of five seconds every ten seconds, and an object in the middle of each.
std::shared_ptr<const MissionTimeline> Regular(int scans) {
  MissionTimeline timeline;
  for (int i = 0; i < scans; ++i) {
    TimelineEntry scan = Moment(TimelineLane::kScans, 10 * i * kMarksSecond);
    scan.end_utc_ns += 5 * kMarksSecond;
    timeline.entries.push_back(scan);
    timeline.entries.push_back(Moment(TimelineLane::kFits, (10 * i + 2) * kMarksSecond));
  }
  timeline.end_utc_ns = timeline.entries.back().end_utc_ns;
  return std::make_shared<const MissionTimeline>(std::move(timeline));
}

TimelineAxis AxisOf(std::int64_t begin, std::int64_t end) {
  TimelineAxis axis;
  axis.SetWidth(1000.0);
  axis.SetLimits(0, 100'000 * kMarksSecond);
  axis.ShowSpan(begin, end);
  return axis;
}

TEST(TimelineMarks, OnlyWhatIsInSightIsMarked) {
  const TimelineMarks marks(Regular(10'000));
  const TimelineAxis axis = AxisOf(50'000 * kMarksSecond, 50'100 * kMarksSecond);
  const auto scans = marks.InSight(TimelineLane::kScans, axis, 1.0);
  ASSERT_GE(scans.size(), 11u);
  EXPECT_LE(scans.size(), 13u);
  for (const TimelineMark& mark : scans) {
    EXPECT_EQ(mark.count, 1);
    EXPECT_GE(mark.x_end, 0.0);
    EXPECT_LE(mark.x, 1000.0);
  }
}

TEST(TimelineMarks, AScanThatBeginsBeforeWhatIsInSightAndReachesIntoItIsMarked) {
  const TimelineMarks marks(Regular(10));
  const TimelineAxis axis =
      AxisOf(32 * kMarksSecond, 34 * kMarksSecond);  // within the scan from 30 to 35
  const auto scans = marks.InSight(TimelineLane::kScans, axis, 1.0);
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_LT(scans[0].x, 0.0);
  EXPECT_GT(scans[0].x_end, 1000.0);
}

TEST(TimelineMarks, WhatIsTooCloseTogetherIsOneMarkAndNoneIsLost) {
  const TimelineMarks marks(Regular(10'000));
  TimelineAxis axis;
  axis.SetWidth(1000.0);
  axis.SetLimits(0, 100'000 * kMarksSecond);
  const auto found = marks.InSight(TimelineLane::kFits, axis, 20.0);
  EXPECT_LE(found.size(), 51u) << "as many as fit beside each other";
  int count = 0;
  for (const TimelineMark& mark : found) count += mark.count;
  EXPECT_EQ(count, 10'000);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i].x - found[i - 1].x, 19.9);
}

TEST(TimelineMarks, StepsGoFromOneEventToTheNextAndStayAtTheEnds) {
  const TimelineMarks marks(Regular(2));
  std::vector<std::int64_t> steps = {-1};
  for (int i = 0; i < 7; ++i) steps.push_back(marks.NextTime(steps.back()));
  EXPECT_EQ(steps,
            (std::vector<std::int64_t>{-1, 0, 2 * kMarksSecond, 5 * kMarksSecond, 10 * kMarksSecond,
                                       12 * kMarksSecond, 15 * kMarksSecond, 15 * kMarksSecond}));
  EXPECT_EQ(marks.PreviousTime(10 * kMarksSecond), 5 * kMarksSecond);
  EXPECT_EQ(marks.PreviousTime(0), 0);
}

}  // namespace
}  // namespace foresight
