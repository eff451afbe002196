#include "ui/viewmodels/replay_model.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/review/mission_for_review.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

template <class Array>
std::string BytesOf(const Array& array) {
  return {reinterpret_cast<const char*>(array.data()), array.size() * sizeof(*array.data())};
}

/// All that the panes show of a document.
struct Shown {
  std::shared_ptr<const Scan> scan;
  std::string points, ranges, depth, confidence, mask;
  std::vector<std::string> objects;

  explicit Shown(const SessionModel& session) : scan(session.CurrentScan()) {
    points = BytesOf(session.Cloud()->points);
    ranges = BytesOf(session.Cloud()->range_m);
    depth = BytesOf(session.Depth()->dense.depth_m.values());
    confidence = BytesOf(session.Depth()->dense.confidence.values());
    mask = BytesOf(session.Mask()->values());
    for (const FoundObject& object : session.Objects())
      objects.push_back(fmt::format("{} {} {}", object.uuid, ToString(object.decision),
                                    object.name.toStdString()));
  }
};

struct ReplayTest : testing::Test {
  MissionForReview mission;
  TaskQueue tasks;
  SessionModel session{SessionMode::kReplay, &tasks};
  DepthViewModel depth{&session};
  ReviewViewModel review{&session};
  TimelineModel timeline{&review, &session};
  ReplayModel replay{&review, &session, &depth, &timeline};
  std::vector<Notice> notices;

  ReplayTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  void SetUp() override { ASSERT_TRUE(Show(mission.First().uuid)); }
  bool Show(const std::string& scan_uuid) {
    review.Open(mission.Path(), scan_uuid);
    return WaitFor(
        [&] { return !review.Busy() && timeline.Timeline() && session.Depth() && tasks.Idle(); });
  }
  bool Seek(std::int64_t utc_ns) {
    replay.SeekTo(utc_ns);
    return Settled();
  }
  bool Settled() {
    return WaitFor([&] { return tasks.Idle(); });
  }
  std::int64_t AfterBegin(double seconds) const {
    return mission.FirstBegin() + static_cast<std::int64_t>(1e9 * seconds);
  }
  std::int64_t AfterEnd(double seconds) const {
    return mission.FirstEnd() + static_cast<std::int64_t>(1e9 * seconds);
  }
};

TEST_F(ReplayTest, AMomentOfTheSweepShowsTheLinesThatHadComeAndNothingElse) {
  ASSERT_TRUE(Seek(AfterBegin(0.8)));
  EXPECT_TRUE(replay.Active());
  EXPECT_EQ(session.CurrentScan(), nullptr) << "the scan is not whole yet";
  ASSERT_NE(session.Cloud(), nullptr);
  EXPECT_NEAR(session.Cloud()->lines, 32, 2);
  EXPECT_EQ(session.Part().lines, session.Cloud()->lines);
  EXPECT_EQ(session.Part().of_lines, 80);
  EXPECT_EQ(session.CurrentImage(), nullptr);
  EXPECT_EQ(session.Depth(), nullptr);
  EXPECT_TRUE(session.Objects().empty());
  ASSERT_TRUE(Seek(AfterBegin(1.2)));
  EXPECT_NE(session.CurrentImage(), nullptr) << "it was taken after one second";
  ASSERT_TRUE(Seek(AfterBegin(0.5)));
  EXPECT_NEAR(session.Cloud()->lines, 20, 2) << "scrubbing back takes lines away again";
  EXPECT_EQ(session.CurrentImage(), nullptr);
  EXPECT_TRUE(notices.empty());
}

TEST_F(ReplayTest, DepthObjectsAndDecisionsAppearWhenTheyWereMade) {
  ASSERT_TRUE(Seek(AfterEnd(0.5)));
  EXPECT_EQ(session.CurrentScan()->lines.size(), 80u);
  EXPECT_EQ(session.Depth(), nullptr) << "it was computed a second after the scan's end";
  ASSERT_TRUE(Seek(AfterEnd(1.5)));
  EXPECT_NE(session.Depth(), nullptr);
  EXPECT_TRUE(session.Objects().empty()) << "the valve was found after three seconds";
  ASSERT_TRUE(Seek(AfterEnd(3.5)));
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(session.Objects()[0].decision, Decision::kOpen);
  ASSERT_TRUE(Seek(AfterEnd(4.5)));
  EXPECT_EQ(session.Objects()[0].decision, Decision::kAccepted);
  ASSERT_TRUE(Seek(AfterEnd(0.5)));
  EXPECT_EQ(session.Depth(), nullptr);
  EXPECT_TRUE(session.Objects().empty());
}

TEST_F(ReplayTest, PlayedToTheEndOrLeftBeforeAllIsAsItWasBitForBit) {
  ASSERT_TRUE(Show(mission.Second().uuid));
  const Shown second(session);
  ASSERT_TRUE(Show(mission.First().uuid));
  const Shown first(session);
  const auto expect_same = [&](const Shown& before) {
    ASSERT_TRUE(WaitFor([&] { return session.Depth() != nullptr && tasks.Idle(); }));
    const Shown after(session);
    EXPECT_EQ(after.scan->uuid, before.scan->uuid);
    EXPECT_TRUE(after.scan->lines == before.scan->lines);
    EXPECT_TRUE(after.scan->track == before.scan->track);
    EXPECT_TRUE(after.scan->frames == before.scan->frames);
    EXPECT_EQ(after.scan->state, ScanState::kComplete);
    EXPECT_TRUE(after.points == before.points);
    EXPECT_TRUE(after.ranges == before.ranges);
    EXPECT_TRUE(after.depth == before.depth);
    EXPECT_TRUE(after.confidence == before.confidence);
    EXPECT_TRUE(after.mask == before.mask);
    EXPECT_EQ(after.objects, before.objects);
  };
  ASSERT_TRUE(Seek(AfterBegin(0.7)));
  replay.leave();
  EXPECT_FALSE(replay.Active());
  expect_same(first);

  replay.play();
  EXPECT_TRUE(replay.Playing());
  std::set<int> lines;
  ASSERT_TRUE(WaitFor([&] {
    replay.Advance(session.CurrentScan() ? 5.0 : 0.06);
    if (session.Cloud() && !session.CurrentScan()) lines.insert(session.Cloud()->lines);
    return !replay.Active();
  }));
  EXPECT_GT(lines.size(), 20u) << "the lines came one after the other";
  EXPECT_FALSE(replay.Playing());
  EXPECT_EQ(review.ScanIndex(), 1) << "it played into the second scan";
  expect_same(second);
  EXPECT_TRUE(notices.empty());
}

TEST_F(ReplayTest, TheSpeedCountsInRealTimeFromAQuarterTo64Times) {
  replay.play();
  ASSERT_TRUE(Settled());
  replay.pause();
  const std::int64_t at = replay.Now();
  replay.play();
  replay.SetSpeed(4.0);
  replay.Advance(0.25);
  EXPECT_NEAR(static_cast<double>(replay.Now() - at), 1e9, 3e8) << "the timer may have run, too";
  for (int i = 0; i < 10; ++i) replay.faster();
  EXPECT_EQ(replay.Speed(), 64.0);
  for (int i = 0; i < 20; ++i) replay.slower();
  EXPECT_EQ(replay.Speed(), 0.25);
}

TEST_F(ReplayTest, IdleTimeIsSkippedUnlessItIsSwitchedOff) {
  // The warning is the last event before the second scan, most of a minute later.
  const std::int64_t last = timeline.Marks().PreviousTime(mission.SecondBegin());
  ASSERT_GT(mission.SecondBegin() - last, 30 * kSecond_ns);
  const auto play_after_the_last = [&] {
    replay.pause();
    EXPECT_TRUE(Seek(last));
    replay.play();
    replay.Advance(0.5);
    EXPECT_LT(replay.Now(), last + kSecond_ns) << "what happened last is looked at";
    replay.Advance(1.0);
    replay.pause();
    return replay.Now();
  };
  EXPECT_TRUE(replay.SkipsIdle());
  EXPECT_NEAR(static_cast<double>(play_after_the_last() - mission.SecondBegin()), -0.5e9, 3e8);
  replay.toggleSkipsIdle();
  EXPECT_NEAR(static_cast<double>(play_after_the_last() - last), 1.5e9, 3e8);
}

TEST_F(ReplayTest, ASweepIsNoIdleTime) {
  ASSERT_TRUE(Seek(mission.SecondBegin() + kSecond_ns * 11 / 10));
  replay.play();
  replay.SetSpeed(0.25);
  replay.Advance(0.4);
  EXPECT_NEAR(static_cast<double>(replay.Now() - mission.SecondBegin()), 1.2e9, 0.1e9)
      << "a second after its begin and half a second before its end";
}

TEST_F(ReplayTest, PausedTheMomentStays) {
  replay.play();
  ASSERT_TRUE(WaitFor([&] { return replay.Now() > AfterBegin(0.2); }));
  replay.pause();
  ASSERT_TRUE(Settled());
  const std::int64_t at = replay.Now();
  replay.Advance(10.0);
  EXPECT_EQ(replay.Now(), at);
  EXPECT_TRUE(replay.Active()) << "the moment is still shown";
}

TEST_F(ReplayTest, StepsGoToTheNextEventAndBack) {
  ASSERT_TRUE(Seek(AfterEnd(0.5)));
  replay.nextEvent();
  EXPECT_EQ(replay.Now(), AfterEnd(1.0)) << "the depth";
  replay.nextEvent();
  EXPECT_EQ(replay.Now(), AfterEnd(3.0)) << "the valve";
  replay.previousEvent();
  EXPECT_EQ(replay.Now(), AfterEnd(1.0));
  ASSERT_TRUE(Settled());
  EXPECT_NE(session.Depth(), nullptr);
}

TEST_F(ReplayTest, AMomentOfAnotherScanShowsThatScan) {
  ASSERT_TRUE(Seek(mission.SecondBegin() + kSecond_ns));
  EXPECT_EQ(review.ScanIndex(), 1);
  ASSERT_NE(session.ShownScan(), nullptr);
  EXPECT_EQ(session.ShownScan()->uuid, mission.Second().uuid);
  EXPECT_NEAR(session.Cloud()->lines, 40, 2);
}

TEST_F(ReplayTest, AScanThatIsAskedForEndsTheReplay) {
  ASSERT_TRUE(Seek(AfterBegin(0.5)));
  ASSERT_TRUE(Show(mission.Second().uuid));
  EXPECT_FALSE(replay.Active());
  EXPECT_EQ(session.CurrentScan()->uuid, mission.Second().uuid);
  EXPECT_NE(session.Depth(), nullptr) << "depth follows by itself again";
}

TEST_F(ReplayTest, TheMissionIsNotTouched) {
  const std::string before = mission.Bytes();
  replay.play();
  replay.SetSpeed(64.0);
  ASSERT_TRUE(WaitFor([&] {
    replay.Advance(0.02);
    return !replay.Active();
  }));
  review.close();
  ASSERT_TRUE(Settled());
  EXPECT_TRUE(mission.Bytes() == before);
}

TEST_F(ReplayTest, WhatIsFoundDuringAReplayStaysAndIsKeptInTheReview) {
  ASSERT_TRUE(Seek(AfterBegin(1.5)));
  FoundObject found;
  found.scan_uuid = mission.First().uuid;
  found.rig = mission.First().rig;
  ValveDetection detection;
  detection.origin.roi = ImageRoi::Rectangle(0.0, {10, 10}, {50, 50});
  found.detection = detection;
  session.AddObject(found);
  ASSERT_TRUE(WaitFor([&] { return !review.Busy() && tasks.Idle(); }));
  ASSERT_TRUE(Seek(AfterBegin(1.6)));
  ASSERT_EQ(session.Objects().size(), 1u);
  EXPECT_EQ(session.Objects()[0].uuid, found.uuid);
  replay.leave();
  ASSERT_TRUE(Settled());
  EXPECT_EQ(session.Objects().size(), 2u) << "beside the valve of the mission";
  ASSERT_TRUE(Show(mission.First().uuid));
  EXPECT_EQ(session.Objects().size(), 2u);
}

TEST_F(ReplayTest, ClosingTheMissionEndsTheReplay) {
  replay.play();
  ASSERT_TRUE(Settled());
  review.close();
  ASSERT_TRUE(Settled());
  EXPECT_FALSE(replay.Active());
  EXPECT_FALSE(replay.Playing());
  EXPECT_FALSE(replay.WhyNot().isEmpty());
  EXPECT_EQ(session.ShownScan(), nullptr);
}

}  // namespace
}  // namespace foresight
