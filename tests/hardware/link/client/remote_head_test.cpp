#include "hardware/link/client/remote_head.h"

#include <gmock/gmock.h>

#include <future>

#include "core/sensor/rig_id.h"
#include "hardware/head/scan_assembler.h"
#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/link/fake_stand.h"
#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// Collects a scan, and says when it has ended.
class Collector final : public ScanSink {
 public:
  void OnScanStarted(const Scan& header) override {
    assembler_.OnScanStarted(header);
    started = true;
  }
  void OnLine(const LidarLine& line) override { assembler_.OnLine(line); }
  void OnMotorSamples(std::span<const MotorSample> samples) override {
    assembler_.OnMotorSamples(samples);
  }
  void OnFrame(const CameraFrame& frame) override { assembler_.OnFrame(frame); }
  void OnScanEnded(ScanState state, const std::string& reason) override {
    assembler_.OnScanEnded(state, reason);
    ended = true;
  }
  Scan Get() const { return *assembler_.Snapshot(); }

  std::atomic<bool> started{false};
  std::atomic<bool> ended{false};

 private:
  ScanAssembler assembler_;
};

/// A mission file on a disk that takes its time, or nothing.
class SlowSink final : public ScanSink {
 public:
  void OnScanStarted(const Scan& /*header*/) override {}
  void OnLine(const LidarLine& /*line*/) override {}
  void OnMotorSamples(std::span<const MotorSample> /*samples*/) override {}
  void OnFrame(const CameraFrame& /*frame*/) override {}
  void OnScanEnded(ScanState /*state*/, const std::string& /*reason*/) override { ++ends; }
  Status WaitUntilKept() override {
    asked = true;
    return outcome_.get();
  }
  void Kept(const Status& kept) { kept_.set_value(kept); }

  std::atomic<bool> asked{false};
  std::atomic<int> ends{0};

 private:
  std::promise<Status> kept_;
  const std::shared_future<Status> outcome_ = kept_.get_future().share();
};

class RemoteArchive final : public ScanArchive {
 public:
  Status Keep(const Scan& whole) override {
    const std::lock_guard lock(mutex_);
    scans_.push_back(whole);
    return {};
  }
  std::vector<Scan> Scans() const {
    const std::lock_guard lock(mutex_);
    return scans_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Scan> scans_;
};

class RemoteHeadTest : public testing::Test {
 protected:
  std::shared_ptr<RemoteHead> Ready(std::shared_ptr<ScanArchive> archive = nullptr) {
    auto remote = bench.Connect(std::move(archive)).value();
    head->SetState(HeadState::kReady);
    EXPECT_TRUE(Eventually([&] { return remote->Status().state == HeadState::kReady; }));
    return remote;
  }
  /// The head measures so many lines, with the motor's samples; the scan runs on.
  bool PlayLines(int count) {
    if (!Eventually([&] { return head->Sink() != nullptr; })) return false;
    const Scan sample = SampleScan(6);
    Scan header = sample;
    header.lines.clear();
    header.frames.clear();
    header.track = {};
    head->Sink()->OnScanStarted(header);
    LidarLine line = sample.lines[0];
    for (int i = 0; i < count; ++i, ++line.seq, line.time_s += 0.025) head->Sink()->OnLine(line);
    return Eventually([&] { return bench.shelf().List().back().lines == count; });
  }
  /// What the head has of the newest scan.
  Scan OnHead() { return *bench.shelf().Snapshot(bench.shelf().List().back().uuid).value(); }
  bool Confirmed() {
    return Eventually([&] {
      const auto scans = bench.shelf().List();
      return !scans.empty() && scans.back().confirmed;
    });
  }

  const std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>();
  HeadBench bench{head};
};

TEST_F(RemoteHeadTest, KnowsTheHeadAndItsRig) {
  const auto remote = bench.Connect().value();
  EXPECT_THAT(remote->Describe(), HasSubstr("fake head at 127.0.0.1:"));
  EXPECT_EQ(RigId(remote->Rig()), RigId(DefaultSensorRig()));
  EXPECT_TRUE(remote->Simulated());
  EXPECT_TRUE(Eventually([&] { return remote->Health().connected; }));
  EXPECT_TRUE(remote->Health().has_control);
}

TEST_F(RemoteHeadTest, ACommandShowsInTheStatus) {
  const auto remote = bench.Connect().value();
  EXPECT_TRUE(Eventually([&] { return remote->Health().connected; }));
  std::promise<void> may_home;
  head->may_home = may_home.get_future().share();
  ASSERT_TRUE(remote->Home());
  EXPECT_EQ(remote->Status().state, HeadState::kHoming) << "before the head has answered";
  may_home.set_value();
  EXPECT_TRUE(Eventually([&] { return remote->Status().state == HeadState::kReady; }));
  EXPECT_EQ(head->homings, 1);
}

TEST_F(RemoteHeadTest, AScanArrivesAsTheHeadHasIt) {
  const auto remote = Ready();
  const auto sink = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  EXPECT_EQ(remote->Status().state, HeadState::kSweeping);
  ASSERT_TRUE(Eventually([&] { return head->Sink() != nullptr; }));
  head->Play(SampleScan(6));
  ASSERT_TRUE(Eventually([&] { return sink->ended.load(); }));
  EXPECT_EQ(ScanDigest(sink->Get()), ScanDigest(OnHead()));
  EXPECT_EQ(sink->Get().lines.size(), SampleScan(6).lines.size());
  EXPECT_TRUE(Confirmed());
  EXPECT_TRUE(std::filesystem::is_empty(bench.folder / "spool"));
  EXPECT_TRUE(Eventually([&] { return remote->Status().state == HeadState::kReady; }));
}

TEST_F(RemoteHeadTest, TheSpoolStaysUntilTheSinkHasKeptTheScan) {
  const auto remote = Ready();
  const auto sink = std::make_shared<SlowSink>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  ASSERT_TRUE(Eventually([&] { return head->Sink() != nullptr; }));
  head->Play(SampleScan(6));
  const bool asked = Eventually([&] { return sink->asked.load(); });
  EXPECT_TRUE(asked);
  EXPECT_FALSE(std::filesystem::is_empty(bench.folder / "spool"));
  EXPECT_FALSE(bench.shelf().List().back().confirmed) << "the head might delete its scan";
  sink->Kept({});
  EXPECT_TRUE(Confirmed());
  EXPECT_TRUE(std::filesystem::is_empty(bench.folder / "spool"));
}

TEST_F(RemoteHeadTest, AScanThatTheSinkCouldNotKeepStaysInTheSpoolAndAtTheHead) {
  auto remote = Ready();
  const auto sink = std::make_shared<SlowSink>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  ASSERT_TRUE(Eventually([&] { return head->Sink() != nullptr; }));
  head->Play(SampleScan(6));
  ASSERT_TRUE(Eventually([&] { return sink->asked.load(); }));
  sink->Kept(Fail(ErrorCode::kIo, "m.foresight: the disk is full"));
  EXPECT_TRUE(Eventually([&] {
    const auto scans = remote->Scans();
    return scans.size() == 1 && scans[0].trouble == "m.foresight: the disk is full";
  }));
  remote.reset();
  EXPECT_EQ(sink->ends, 1);
  EXPECT_FALSE(std::filesystem::is_empty(bench.folder / "spool"));
  EXPECT_FALSE(bench.shelf().List().back().confirmed);
}

TEST_F(RemoteHeadTest, LinesComeWhileTheScanRuns) {
  const auto remote = Ready();
  const auto sink = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  ASSERT_TRUE(PlayLines(24));
  // Blocks of eight lines; the motor's track comes with them.
  EXPECT_TRUE(Eventually([&] {
    const auto scans = remote->Scans();
    return scans.size() == 1 && scans[0].lines == 24;
  }));
  EXPECT_TRUE(Eventually([&] { return sink->started && sink->Get().lines.size() == 24u; }));
  EXPECT_FALSE(sink->ended);
  head->Sink()->OnScanEnded(ScanState::kAborted, "enough");
  ASSERT_TRUE(Eventually([&] { return sink->ended.load(); }));
  EXPECT_EQ(sink->Get().reason, "enough");
}

TEST_F(RemoteHeadTest, AHeadThatDiesInBetweenLosesNothing) {
  const auto remote = Ready();
  const auto sink = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  ASSERT_TRUE(PlayLines(20));
  bench.StopHead();
  head->Forget();
  EXPECT_TRUE(Eventually([&] { return !remote->Health().connected; }));
  EXPECT_FALSE(remote->StartScan(ScanPlan(), std::make_shared<Collector>()));
  bench.StartHead();
  ASSERT_TRUE(Eventually([&] { return sink->ended.load(); }));
  EXPECT_EQ(sink->Get().state, ScanState::kInterrupted);
  EXPECT_EQ(sink->Get().lines.size(), 20u);
  EXPECT_EQ(ScanDigest(sink->Get()), ScanDigest(OnHead()));
  EXPECT_TRUE(Confirmed());
}

TEST_F(RemoteHeadTest, AStationThatDiesInBetweenGetsTheRestForItsArchive) {
  const auto archive = std::make_shared<RemoteArchive>();
  auto remote = Ready(archive);
  const auto sink = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  ASSERT_TRUE(PlayLines(20));
  ASSERT_TRUE(Eventually([&] { return !remote->Scans().empty() && remote->Scans()[0].lines > 0; }));
  remote.reset();
  EXPECT_TRUE(sink->ended) << "the sink hears an end whatever happens";
  EXPECT_EQ(sink->Get().state, ScanState::kInterrupted);
  head->Sink()->OnScanEnded(ScanState::kComplete, "");
  remote = bench.Connect(archive).value();
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 1; }));
  EXPECT_EQ(ScanDigest(archive->Scans()[0]), ScanDigest(OnHead()));
  EXPECT_TRUE(Confirmed());
}

TEST_F(RemoteHeadTest, AScanMayBeginBeforeTheOneBeforeHasCome) {
  const auto archive = std::make_shared<RemoteArchive>();
  const auto remote = Ready(archive);
  const auto first = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), first));
  ASSERT_TRUE(PlayLines(16));
  ASSERT_TRUE(Eventually([&] { return first->started && first->Get().lines.size() == 16; }));
  const std::string id = remote->Scans().at(0).scan_id;
  remote->Pause(id);
  EXPECT_EQ(remote->Scans().at(0).place, LinkedScan::Place::kPaused);
  head->Sink()->OnScanEnded(ScanState::kComplete, "");
  head->SetState(HeadState::kReady);
  ASSERT_TRUE(Eventually([&] { return remote->Status().state == HeadState::kReady; }));
  const auto second = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), second));
  ASSERT_TRUE(Eventually([&] { return head->scans == 2; }));
  head->Play(SampleScan(6));
  ASSERT_TRUE(Eventually([&] { return second->ended.load(); }));
  EXPECT_EQ(second->Get().state, ScanState::kComplete);
  EXPECT_TRUE(first->ended);
  EXPECT_THAT(first->Get().reason, HasSubstr("another scan began"));
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 1; }));
  remote->Fetch(id);
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 2; }));
  EXPECT_EQ(archive->Scans()[1].state, ScanState::kComplete);
  EXPECT_EQ(archive->Scans()[1].lines.size(), 16u);
}

TEST_F(RemoteHeadTest, AScanThatAnotherStationMadeIsListedAndComesWhenItIsAskedFor) {
  const auto archive = std::make_shared<RemoteArchive>();
  ASSERT_TRUE(head->Home());
  ASSERT_TRUE(head->StartScan(ScanPlan(), bench.shelf().Begin("scan-of-another", {}).value()));
  head->Play(SampleScan(6));
  ASSERT_TRUE(Eventually([&] { return bench.shelf().List().back().state != ScanState::kRunning; }));
  const auto remote = Ready(archive);
  ASSERT_TRUE(Eventually([&] { return remote->Scans().size() == 1; }));
  const LinkedScan scan = remote->Scans()[0];
  EXPECT_EQ(scan.scan_id, "scan-of-another");
  EXPECT_EQ(scan.place, LinkedScan::Place::kAtHead);
  EXPECT_EQ(scan.of_lines, static_cast<int>(SampleScan(6).lines.size()));
  EXPECT_GT(scan.left_bytes, 0);
  EXPECT_TRUE(archive->Scans().empty());
  remote->FetchFirst(scan.scan_id);
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 1; }));
  EXPECT_EQ(ScanDigest(archive->Scans()[0]), ScanDigest(OnHead()));
  EXPECT_TRUE(Eventually([&] { return remote->Scans().at(0).place == LinkedScan::Place::kHere; }));
  EXPECT_EQ(remote->Scans().at(0).left_bytes, 0);
}

TEST_F(RemoteHeadTest, ControlThatWasGivenAwayIsNotTakenBackByItself) {
  const auto remote = Ready();
  ASSERT_TRUE(remote->Health().has_control);
  ASSERT_TRUE(remote->GiveControl(""));
  EXPECT_FALSE(remote->Health().has_control);
  EXPECT_THAT(remote->Home().error().message, HasSubstr("has control"));
  const std::string token = bench.desk().TakeControl({}, {"bert", true}).token();
  ASSERT_FALSE(token.empty()) << "it was free";
  EXPECT_TRUE(Eventually([&] { return remote->Health().holder == "bert"; }));
  EXPECT_THAT(remote->TakeControl().error().message, HasSubstr("bert has control"));
  link::ReleaseRequest release;
  release.set_token(token);
  bench.desk().ReleaseControl(release);
  EXPECT_TRUE(Eventually([&] { return remote->Health().holder.empty(); }));
  EXPECT_FALSE(remote->Health().has_control);
  ASSERT_TRUE(remote->TakeControl());
  EXPECT_TRUE(remote->Health().has_control);
}

TEST_F(RemoteHeadTest, AnEndThatTheHeadRefusesIsToldWithItsReason) {
  const auto remote = Ready();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), std::make_shared<Collector>()));
  ASSERT_TRUE(Eventually([&] { return head->Sink() != nullptr; }));
  EXPECT_EQ(remote->Health().end_scan, StopAnswer::kNone);
  ASSERT_TRUE(remote->GiveControl(""));
  ASSERT_TRUE(bench.desk().TakeControl({}, {"bert", true}).granted());
  remote->AbortScan();
  EXPECT_TRUE(Eventually([&] { return remote->Health().end_scan == StopAnswer::kRefused; }));
  EXPECT_THAT(remote->Health().end_scan_refusal, HasSubstr("bert has it"));
  EXPECT_EQ(head->EndReason(), "");
}

/// Of the same name, as two programs of one person have.
TEST_F(RemoteHeadTest, WhoLooksOnLeavesControlToWhoHasIt) {
  const auto operating = Ready();
  const auto looking = bench.Connect(nullptr, true).value();
  EXPECT_EQ(looking->Status().state, HeadState::kReady);
  EXPECT_FALSE(looking->Health().has_control);
  EXPECT_FALSE(looking->Home());
  ASSERT_TRUE(operating->Home());
  EXPECT_TRUE(Eventually([&] { return head->homings == 1; }));
}

TEST_F(RemoteHeadTest, AStopNeedsNeitherControlNorASessionThatHasBegun) {
  const auto operating = Ready();
  LinkSession session({bench.Channel()}, "head");
  const auto stopped = StopHead(session, std::chrono::milliseconds(3000), RunContext());
  ASSERT_TRUE(stopped) << stopped.error().message;
  EXPECT_EQ(head->stops, 1);
  bench.peer = {"otto", false};
  const auto refused = StopHead(session, std::chrono::milliseconds(3000), RunContext());
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("otto is an observer"));
  EXPECT_EQ(head->stops, 1);
}

TEST_F(RemoteHeadTest, APoseIsAnsweredByTheHead) {
  const auto remote = Ready();
  const auto answer = remote->SendPose("{}");
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->kind, RobotAnswer::Kind::kRefused);
  EXPECT_THAT(answer->reason, HasSubstr("--robot-socket"));
}

TEST_F(RemoteHeadTest, ARefusedScanHasAnEndThatSaysWhy) {
  const auto remote = Ready();
  // The head goes out of ready while the station does not know it yet.
  bench.peer.may_operate = false;
  const auto sink = std::make_shared<Collector>();
  ASSERT_TRUE(remote->StartScan(ScanPlan(), sink));
  ASSERT_TRUE(Eventually([&] { return sink->ended.load(); }));
  EXPECT_EQ(sink->Get().state, ScanState::kAborted);
  EXPECT_THAT(sink->Get().reason, HasSubstr("anna is an observer"));
  EXPECT_EQ(head->scans, 0);
  EXPECT_THAT(remote->Status().message, HasSubstr("no scan: anna is an observer"));
}

TEST_F(RemoteHeadTest, AScanThatWasAskedForInABlackoutDoesNotStartLater) {
  const auto remote = Ready();
  bench.StopHead();
  const auto sink = std::make_shared<Collector>();
  if (!remote->StartScan(ScanPlan(), sink)) return;              // the loss was noticed already
  std::this_thread::sleep_for(std::chrono::milliseconds(3500));  // longer than the command is good
  bench.StartHead();
  ASSERT_TRUE(Eventually([&] { return sink->ended.load(); }));
  EXPECT_EQ(sink->Get().state, ScanState::kAborted);
  EXPECT_EQ(head->scans, 0);
}

TEST_F(RemoteHeadTest, StopReachesTheHeadAlsoAfterABlackout) {
  const auto remote = Ready();
  remote->StopMotor();
  EXPECT_TRUE(Eventually([&] { return head->stops == 1; }));
  EXPECT_TRUE(Eventually([&] { return remote->Health().stop == StopAnswer::kObeyed; }));
  bench.StopHead();
  remote->StopMotor();
  EXPECT_EQ(remote->Health().stop, StopAnswer::kWaiting) << "the head is not there";
  bench.StartHead();
  EXPECT_TRUE(Eventually([&] { return head->stops == 2; }));
  EXPECT_TRUE(Eventually([&] { return remote->Health().stop == StopAnswer::kObeyed; }));
}

TEST_F(RemoteHeadTest, AnotherRigIsReadBack) {
  const auto remote = Ready();
  SensorRig rig = DefaultSensorRig();
  rig.lidar.range_offset_m = 0.02;
  ASSERT_TRUE(remote->SetRig(rig));
  EXPECT_EQ(RigId(remote->Rig()), RigId(rig));
  EXPECT_EQ(RigId(head->Rig()), RigId(rig));
}

TEST_F(RemoteHeadTest, SignsOfLifeStopWhenNobodyIsThere) {
  const auto remote = Ready();
  const int before = head->signs;
  remote->OperatorSeen();
  EXPECT_TRUE(Eventually([&] {
    remote->OperatorSeen();
    return head->signs > before;
  }));
}

TEST_F(RemoteHeadTest, TheLiveViewShowsWhatTheCameraSees) {
  class View final : public LiveViewSink {
   public:
    void OnLiveImage(const LiveImage& image) override {
      width = image.image.width();
      ++images;
    }
    void OnLiveViewTrouble(const std::string&) override { ++troubles; }
    std::atomic<int> images{0}, troubles{0}, width{0};
  };
  const auto remote = Ready();
  const auto view = std::make_shared<View>();
  ASSERT_TRUE(remote->StartLiveView({}, view));
  ASSERT_TRUE(Eventually([&] { return head->LiveSink() != nullptr; }));
  LiveImage image;
  image.image = ColorImage(40, 30);
  image.full_width = 40;
  image.full_height = 30;
  head->LiveSink()->OnLiveImage(image);
  EXPECT_TRUE(Eventually([&] { return view->images == 1; }));
  EXPECT_EQ(view->width, 40);
  head->LiveSink()->OnLiveViewTrouble("no image");
  EXPECT_TRUE(Eventually([&] { return view->troubles == 1; }));
  remote->StopLiveView();
  EXPECT_TRUE(Eventually([&] { return head->LiveSink() == nullptr; }));
}

TEST_F(RemoteHeadTest, CapturesAtStopsArriveExactly) {
  class Stops final : public StopSink {
   public:
    void OnStop(const StopCapture& capture) override {
      const std::lock_guard lock(mutex);
      captures.push_back(capture);
    }
    void OnStopsEnded(ScanState state, const std::string& why) override {
      reason = why;
      ended = state;
    }
    std::mutex mutex;
    std::string reason;
    std::vector<StopCapture> captures;
    std::atomic<ScanState> ended{ScanState::kRunning};
  };
  const auto remote = Ready();
  const auto stops = std::make_shared<Stops>();
  StopPlan plan;
  plan.angles_rad = {0.1, 0.2};
  ASSERT_TRUE(remote->StartStops(plan, stops));
  ASSERT_TRUE(Eventually([&] { return head->Stops() != nullptr; }));
  StopCapture capture;
  capture.target_rad = 0.1;
  capture.position = {1.25, 0.1001};
  capture.lines = {SampleScan(6).lines[0], SampleScan(6).lines[1]};
  capture.image = SampleScan(6).frames.front();
  head->Stops()->OnStop(capture);
  capture.image.reset();
  head->Stops()->OnStop(capture);
  head->Stops()->OnStopsEnded(ScanState::kComplete, "");
  ASSERT_TRUE(Eventually([&] { return stops->ended != ScanState::kRunning; }));
  ASSERT_EQ(stops->ended, ScanState::kComplete) << stops->reason;
  ASSERT_EQ(stops->captures.size(), 2u);
  EXPECT_EQ(stops->captures[0].lines, capture.lines);
  EXPECT_EQ(stops->captures[0].position, capture.position);
  EXPECT_EQ(*stops->captures[0].image, SampleScan(6).frames.front());
  EXPECT_FALSE(stops->captures[1].image);
}

TEST_F(RemoteHeadTest, TheStandOfASimulatedHeadIsMovedFromHere) {
  FakeStand stand;
  bench.StopHead();
  bench.stand = &stand;
  bench.StartHead();
  const auto remote = Ready();
  const std::shared_ptr<MovingStand> here = remote->Stand();
  ASSERT_NE(here, nullptr);
  EXPECT_EQ(here->Places(), stand.Places());
  EXPECT_EQ(here->Mount(), stand.Mount());
  here->MoveTo(2);
  ASSERT_TRUE(Eventually([&] { return !here->Moving(); }));
  EXPECT_EQ(here->Trouble(), "");
  EXPECT_EQ(here->At(), 2);
  EXPECT_EQ(stand.at, 2);
  stand.at = 1;
  EXPECT_TRUE(Eventually([&] { return here->At() == 1; })) << "another operator moved it";
  bench.StopHead();
}

TEST_F(RemoteHeadTest, WhereTheStandIsCarriedThereIsNone) {
  EXPECT_EQ(bench.Connect().value()->Stand(), nullptr);
}

TEST_F(RemoteHeadTest, NobodyThereIsAnErrorThatSaysWhatToDo) {
  bench.StopHead();
  const auto remote = bench.Connect();
  ASSERT_FALSE(remote);
  EXPECT_THAT(remote.error().message, HasSubstr("is foresight-head running there"));
}

}  // namespace
}  // namespace foresight
