// The replay beside a live head: what it must not touch.
#include <gtest/gtest.h>

#include "app/workstation/workbench.h"
#include "tests/review/mission_for_review.h"
#include "tests/ui/linked_head.h"
#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

struct ReplayInWorkbench : testing::Test {
  MissionForReview mission;
  QTemporaryDir missions;
  std::shared_ptr<LinkedHead> head = std::make_shared<LinkedHead>(mission.First().rig);
  Workbench bench{head, SessionMode::kLive};
  std::vector<QString> refused;

  ReplayInWorkbench() {
    EXPECT_TRUE(bench.recording.BeginInFolder(missions.path()));
    QObject::connect(&bench.commands, &CommandTable::refused,
                     [this](const QString&, const QString& why) { refused.push_back(why); });
    bench.reviewer.Open(mission.Path(), mission.First().uuid);
  }
  void SetUp() override {
    ASSERT_TRUE(WaitFor([&] { return bench.ShowsReview() && Settled(); }));
  }
  bool Settled() { return bench.timeline.Timeline() && bench.tasks.Idle(); }
};

TEST_F(ReplayInWorkbench, NothingOfItCanBeSentToARobot) {
  {
    const std::lock_guard lock(head->link.mutex);
    head->link.health.connected = head->link.health.has_control = true;
  }
  bench.replay.SeekTo(mission.FirstEnd() + 5 * kSecond_ns);
  ASSERT_TRUE(WaitFor([&] { return bench.tasks.Idle(); }));
  ASSERT_EQ(bench.review.session.Objects().size(), 1u);
  ASSERT_EQ(bench.review.session.Objects()[0].decision, Decision::kAccepted);
  bench.review.session.SelectObject(0);
  EXPECT_FALSE(bench.commands.Run("object.send"));
  EXPECT_FALSE(bench.commands.Run("head.scan"));
  EXPECT_FALSE(bench.commands.Run("object.fit_on_robot"));
  EXPECT_EQ(refused.size(), 3u);
  bench.backToLive();
  EXPECT_FALSE(bench.commands.Run("object.send")) << "nor after going back to live";
  EXPECT_TRUE(head->link.Asked().empty());
}

TEST_F(ReplayInWorkbench, NothingOfItIsWrittenIntoTheRecording) {
  EXPECT_TRUE(bench.commands.Run("review.play"));
  EXPECT_TRUE(bench.commands.Run("review.faster"));
  ASSERT_TRUE(WaitFor([&] { return !bench.replay.Loading(); }));
  EXPECT_TRUE(bench.commands.Run("review.next_event"));
  EXPECT_TRUE(bench.commands.Run("review.whole"));
  EXPECT_TRUE(bench.commands.Run("view.live"));
  ASSERT_TRUE(bench.recording.WriteAll());
  const auto file = MissionFile::OpenReadOnly(bench.recording.Path().toStdString()).value();
  EXPECT_TRUE(file->ListScans()->empty());
  EXPECT_TRUE(file->ListDetections()->empty());
  const std::vector<EventRecord> events = file->ListEvents().value();
  EXPECT_FALSE(events.empty()) << "going back to live is kept";
  for (const EventRecord& event : events)
    EXPECT_EQ(event.text.find("review."), std::string::npos) << event.text;
  EXPECT_EQ(bench.live.session.ShownScan(), nullptr);
}

TEST_F(ReplayInWorkbench, ALiveScanGoesOnWhileAReplayPlays) {
  EXPECT_TRUE(bench.commands.Run("review.play"));
  bench.backToLive();
  bench.head.scan();
  head->Deliver(mission.Second(), 10);
  bench.head.Poll();
  EXPECT_TRUE(bench.head.Scanning());
  EXPECT_TRUE(bench.replay.Active());
  head->Finish(mission.Second(), ScanState::kComplete);
  bench.head.Poll();
  ASSERT_TRUE(WaitFor([&] { return bench.live.session.CurrentScan() != nullptr; }));
  EXPECT_EQ(bench.live.session.CurrentScan()->uuid, mission.Second().uuid);
  bench.replay.leave();
  EXPECT_TRUE(WaitFor([&] { return bench.Idle() && bench.recording.Waiting() == 0; }));
}

TEST_F(ReplayInWorkbench, TheReplaysCommandsHaveKeysAndNeedAReviewOnTheScreen) {
  int rows = 0;
  for (const auto& command : bench.commands.All()) {
    if (!QString::fromLatin1(command->id).startsWith(QLatin1String("review."))) continue;
    ++rows;
    EXPECT_FALSE(command->keys.isEmpty()) << command->id;
    for (const auto& other : bench.commands.All())
      EXPECT_TRUE(other == command || other->keys != command->keys)
          << command->id << " and " << other->id;
  }
  EXPECT_GE(rows, 11);
  bench.backToLive();
  EXPECT_FALSE(bench.commands.Get("review.play").Allowed());
}

TEST_F(ReplayInWorkbench, TheLinksStateIsKeptForTheTimeline) {
  const auto set_connected = [&](bool connected) {
    const std::lock_guard lock(head->link.mutex);
    head->link.health.connected = connected;
  };
  set_connected(true);
  bench.link->Poll();
  set_connected(false);
  bench.link->Poll();
  bench.link->Poll();
  ASSERT_TRUE(bench.recording.WriteAll());
  const auto file = MissionFile::OpenReadOnly(bench.recording.Path().toStdString()).value();
  const MissionTimeline read = ReadTimeline(*file, nullptr).value();
  std::vector<TimelineEntry::Kind> link;
  for (const TimelineEntry& entry : read.entries)
    if (entry.lane == TimelineLane::kLink) link.push_back(entry.kind);
  EXPECT_EQ(link, (std::vector{TimelineEntry::Kind::kLinkLost, TimelineEntry::Kind::kLinkUp,
                               TimelineEntry::Kind::kLinkLost}))
      << "as it was when recording began, and each change once";
}

TEST_F(ReplayInWorkbench, ClosingTheLastMissionGoesBackToLive) {
  EXPECT_TRUE(bench.commands.Run("review.close"));
  EXPECT_FALSE(bench.ShowsReview());
}

}  // namespace
}  // namespace foresight
