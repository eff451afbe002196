#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "tests/ui/fake_head.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/depth_view_model.h"
#include "ui/viewmodels/fit_view_model.h"
#include "ui/viewmodels/live_depth_view_model.h"
#include "ui/viewmodels/scan_flow.h"

namespace foresight {
namespace {

std::shared_ptr<const Scan> ScanOfSession() {
  // 6 deg/s over 30 deg is dense enough for a fit; made once, as it takes a while.
  static const auto scan = std::make_shared<const Scan>(
      WallAndValveScan({.from_rad = -0.26, .to_rad = 0.26, .speed_rad_s = 0.10}));
  return scan;
}

struct SessionTest : testing::Test {
  SessionModel session{SessionMode::kSimulation};
  DepthViewModel depth{&session};
  FitViewModel fit{&session};
  std::vector<Notice> notices;

  SessionTest() {
    QObject::connect(&session, &SessionModel::noticed,
                     [this](const Notice& notice) { notices.push_back(notice); });
  }
  bool ComputeDepthOf(const std::shared_ptr<const Scan>& scan) {
    session.SetScan(scan);
    return WaitFor([&] { return !depth.Runner()->Busy(); }) && session.Depth() != nullptr;
  }
  std::ptrdiff_t Kept() const {
    const auto values = session.Mask()->values();
    return std::count(values.begin(), values.end(), 255);
  }
  /// Two corners around the valve in the image.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> AroundValve() const {
    const auto camera_from_base =
        session.CurrentScan()->rig.CameraFromBase(session.CurrentImage()->motor_angle_rad);
    const auto center = session.CurrentScan()->rig.camera.Project(
        camera_from_base * SyntheticValvePose().translation());
    const Eigen::Vector2d half(50, 50);
    return {*center - half, *center + half};
  }
};

TEST_F(SessionTest, AScanBecomesDepthByItself) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  EXPECT_NE(session.Cloud(), nullptr);
  EXPECT_EQ(session.Depth()->dense.depth_m.width(), ScanOfSession()->rig.camera.width);
  EXPECT_TRUE(notices.empty());
}

TEST_F(SessionTest, OnlyACompleteScanIsAskedForItsImage) {
  Scan scan = *ScanOfSession();
  scan.frames.clear();
  scan.state = ScanState::kInterrupted;
  session.SetScan(std::make_shared<const Scan>(scan));
  ASSERT_TRUE(WaitFor([&] { return !depth.Runner()->Busy(); }));
  EXPECT_TRUE(notices.empty()) << "why the scan was interrupted is what matters";
  scan.uuid = "another";
  scan.state = ScanState::kComplete;
  session.SetScan(std::make_shared<const Scan>(scan));
  ASSERT_TRUE(WaitFor([&] { return !notices.empty(); }));
  EXPECT_EQ(notices[0].what, QStringLiteral("The scan holds no image, so there is no depth."));
}

TEST_F(SessionTest, ThresholdChangesTheMaskWithoutComputingDepthAgain) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  const auto before = session.Depth();
  const auto kept_before = Kept();
  depth.setThreshold(0.9);
  EXPECT_LT(Kept(), kept_before);
  EXPECT_EQ(session.Depth(), before);
  EXPECT_FALSE(depth.Runner()->Busy());
  EXPECT_EQ(depth.ComputedCount(), 1);
}

TEST_F(SessionTest, CancelLeavesTheOldDepth) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  const auto before = session.Depth();
  depth.compute();
  depth.Runner()->cancel();
  ASSERT_TRUE(WaitFor([&] { return !depth.Runner()->Busy(); }));
  EXPECT_EQ(session.Depth(), before);
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices.back().level, Notice::Level::kInfo);
}

TEST_F(SessionTest, ANewScanNeverShowsTheDepthOfTheOneBefore) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  session.SetScan(std::make_shared<const Scan>(*ScanOfSession()));
  EXPECT_EQ(session.Depth(), nullptr);
  EXPECT_EQ(session.Cloud(), nullptr);
}

TEST_F(SessionTest, NoSignalOfANewScanLetsTheOldImageOrDepthBeSeen) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  int heard = 0;
  for (auto signal : {&SessionModel::scanChanged, &SessionModel::cloudChanged,
                      &SessionModel::roiChanged, &SessionModel::objectsChanged})
    QObject::connect(&session, signal, [&] {
      ++heard;
      EXPECT_EQ(session.CurrentImage(), nullptr);
      EXPECT_EQ(session.Depth(), nullptr);
    });
  session.SetScan(nullptr);
  EXPECT_EQ(heard, 4);
}

TEST_F(SessionTest, AFailedFitIsReportedAndListedNowhere) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  fit.SetTool(ObjectKind::kValve, true);
  fit.DrawRegion({{20, 20}, {60, 60}});  // nothing but wall
  ASSERT_TRUE(WaitFor([&] { return !fit.Runner()->Busy(); }));
  EXPECT_TRUE(session.Objects().empty());
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices.back().level, Notice::Level::kError);
  EXPECT_FALSE(notices.back().next.isEmpty());
}

TEST_F(SessionTest, DrawingOverAValveWithTheToolFindsIt) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  fit.SetTool(ObjectKind::kValve, true);
  const auto [a, b] = AroundValve();
  fit.DrawRegion({a, b});
  ASSERT_TRUE(WaitFor([&] { return !fit.Runner()->Busy(); }));
  ASSERT_EQ(session.Objects().size(), 1u) << (notices.empty() ? "" : notices[0].what.toStdString());
  const auto& found = std::get<ValveDetection>(session.Objects()[0].detection);
  const double miss_m =
      (found.best.base_from_object.translation() - SyntheticValvePose().translation()).norm();
  EXPECT_LT(miss_m, 0.02);  // the tool's own accuracy is tested with the fit: here only "the valve"
}

TEST_F(SessionTest, ARegionOfAnotherObjectWaitsForTheFitBefore) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  const auto [a, b] = AroundValve();
  fit.SetTool(ObjectKind::kValve, true);
  fit.DrawRegion({a, b});
  fit.DrawRegion({{20, 20}, {60, 60}});  // elsewhere: nothing but wall
  fit.SetTool(ObjectKind::kCylinder, true);
  fit.DrawRegion({a, b});
  ASSERT_TRUE(WaitFor([&] { return !fit.Runner()->Busy(); }));
  ASSERT_FALSE(session.Objects().empty());
  EXPECT_EQ(ObjectKindOf(session.Objects()[0].detection), ObjectKind::kValve);
  ASSERT_FALSE(notices.empty());
  EXPECT_TRUE(notices[0].what.startsWith(QStringLiteral("Fitting the valve failed")))
      << notices[0].what.toStdString();
  // A cylinder is no such thing; either answer tells that it was looked for.
  EXPECT_EQ(session.Objects().size() + notices.size(), 3u);
}

TEST_F(SessionTest, ARegionDrawnAgainReplacesTheFitBefore) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  const auto [a, b] = AroundValve();
  fit.SetTool(ObjectKind::kValve, true);
  fit.DrawRegion({a, b});
  fit.DrawRegion({a - Eigen::Vector2d(5, 5), b + Eigen::Vector2d(5, 5)});
  ASSERT_TRUE(WaitFor([&] { return !fit.Runner()->Busy(); }));
  EXPECT_EQ(session.Objects().size(), 1u);
  EXPECT_TRUE(notices.empty()) << notices[0].what.toStdString();
}

TEST_F(SessionTest, AClickIsNotARegion) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  fit.DrawRegion({{100, 100}, {101, 101}});
  EXPECT_FALSE(session.Region());
}

TEST_F(SessionTest, UndoBringsTheRegionBeforeBack) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  fit.DrawRegion({{10, 10}, {50, 50}});
  const auto first = std::get<ImageRoi>(*session.Region()).polygon;
  fit.DrawRegion({{60, 60}, {90, 90}});
  session.Undo()->undo();
  EXPECT_EQ(std::get<ImageRoi>(*session.Region()).polygon, first);
  session.Undo()->undo();
  EXPECT_FALSE(session.Region());
  EXPECT_FALSE(session.Undo()->CanUndo());
  session.Undo()->redo();
  EXPECT_EQ(std::get<ImageRoi>(*session.Region()).polygon, first);
}

TEST_F(SessionTest, AValveOfAnEarlierScanIsNotCurrent) {
  session.SetScan(ScanOfSession());
  FoundObject valve;
  valve.scan_uuid = ScanOfSession()->uuid;
  session.AddObject(valve);
  EXPECT_TRUE(session.IsCurrent(session.Objects()[0]));
  Scan another = *ScanOfSession();
  another.uuid = NewUuid();
  session.SetScan(std::make_shared<const Scan>(std::move(another)));
  EXPECT_FALSE(session.IsCurrent(session.Objects()[0]));
}

struct ScanFlowTest : SessionTest {
  std::shared_ptr<FakeHead> fake = std::make_shared<FakeHead>(ScanOfSession()->rig);
  HeadViewModel head{fake};
  ScanFlow flow{&head, &session};
};

TEST(SessionMemory, TheCloudBeforeIsGivenBackByAnotherThread) {
  TaskQueue tasks;
  SessionModel session(SessionMode::kSimulation, &tasks);
  std::atomic<bool> freed = false;
  std::thread::id freed_by;
  auto before =
      std::shared_ptr<const RegisteredScan>(new RegisteredScan, [&](const RegisteredScan* cloud) {
        freed_by = std::this_thread::get_id();
        delete cloud;
        freed = true;
      });
  session.SetCloud(std::move(before), {});
  session.SetCloud(std::make_shared<const RegisteredScan>(), {});
  ASSERT_TRUE(WaitFor([&] { return freed.load(); }));
  EXPECT_NE(freed_by, std::this_thread::get_id());
}

TEST_F(ScanFlowTest, TheCloudGrowsWhileTheHeadSweeps) {
  head.scan();
  fake->Deliver(*ScanOfSession(), 40);
  ASSERT_TRUE(WaitFor([&] { return session.Cloud() != nullptr; }));
  EXPECT_EQ(session.Cloud()->lines, 40);
  EXPECT_EQ(session.CurrentScan(), nullptr);
}

TEST_F(ScanFlowTest, AnAbortedScanKeepsWhatItHasAndSaysSo) {
  head.scan();
  fake->Deliver(*ScanOfSession(), 40);
  head.abort();
  head.Poll();
  ASSERT_NE(session.CurrentScan(), nullptr);
  EXPECT_EQ(session.CurrentScan()->lines.size(), 40u);
  ASSERT_FALSE(notices.empty());
  EXPECT_TRUE(notices.front().what.contains("aborted"));
}

TEST_F(ScanFlowTest, NothingOfTheOldScanStaysWhenANewOneBegins) {
  ASSERT_TRUE(ComputeDepthOf(ScanOfSession()));
  head.scan();
  EXPECT_EQ(session.CurrentScan(), nullptr);
  EXPECT_EQ(session.Cloud(), nullptr);
  EXPECT_EQ(session.Depth(), nullptr);
}

TEST_F(ScanFlowTest, AnImageIsShownWhenItIsTakenAndNotAtTheEnd) {
  head.scan();
  fake->Deliver(*ScanOfSession(), 40);
  fake->DeliverFrame(ScanOfSession()->frames[0]);
  ASSERT_TRUE(WaitFor([&] { return session.CurrentImage() != nullptr; }));
  EXPECT_EQ(session.CurrentScan(), nullptr) << "the scan is still on its way";
  EXPECT_EQ(session.CurrentImage()->image, ScanOfSession()->frames[0].image);
}

TEST_F(ScanFlowTest, LinesThatComeAfterTheEndAreShownToo) {
  head.scan();
  fake->Deliver(*ScanOfSession(), 40);
  const auto late = fake->FinishButStillSend(*ScanOfSession(), ScanState::kComplete);
  head.Poll();
  ASSERT_NE(session.CurrentScan(), nullptr);
  ASSERT_EQ(session.CurrentScan()->lines.size(), 40u);
  late(40);
  head.Poll();
  EXPECT_EQ(session.CurrentScan()->lines.size(), 41u);
}

TEST_F(ScanFlowTest, AScanThatTheHeadNeverBeginsLeavesTheWindowUsable) {
  head.scan();  // accepted, and then nothing comes
  fake->SetState(HeadState::kReady);
  for (int poll = 0; poll < 40; ++poll) head.Poll();
  EXPECT_FALSE(head.Scanning());
  EXPECT_TRUE(head.CanScan());
  EXPECT_FALSE(session.ExpectsScan());
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices.back().level, Notice::Level::kError);
}

TEST_F(ScanFlowTest, ScanTimeIsWhenTheScanBeganAndNotWhenTheHeadWasSwitchedOn) {
  Scan late = *ScanOfSession();
  std::vector<LidarLine> lines(late.lines.begin(), late.lines.end());
  for (LidarLine& line : lines) line.time_s += 300.0;
  late.lines = lines;
  late.start_utc_ns = 1'000'000'000'000'000'000;
  session.SetScan(std::make_shared<const Scan>(late));
  const qint64 begin_ms =
      late.start_utc_ns / 1'000'000 + static_cast<qint64>(1e3 * late.lines.front().time_s);
  EXPECT_NEAR(static_cast<double>(session.ScanTime().toMSecsSinceEpoch() - begin_ms), 0.0, 1.0);
}

struct LiveDepthTest : ScanFlowTest {
  LiveDepthViewModel live{&head, &session};
};

TEST_F(LiveDepthTest, ASecondScanIsPreviewedUnderTheImageOfTheFirst) {
  PlanFields plan = head.Plan();
  plan.image_angles_deg = {0.0};
  head.SetPlan(plan);
  session.SetScan(ScanOfSession());
  head.scan();
  EXPECT_EQ(live.Depth(), nullptr);
  fake->Deliver(*ScanOfSession(), 60);
  ASSERT_TRUE(WaitFor([&] { return live.Depth() != nullptr; }));
  EXPECT_EQ(live.Lines(), 60);
  EXPECT_EQ(session.Depth(), nullptr) << "nothing can be fitted to a preview";
  fake->Finish(*ScanOfSession(), ScanState::kComplete);
  head.Poll();
  EXPECT_EQ(live.Depth(), nullptr);
}

TEST_F(LiveDepthTest, GrowsWithTheLinesAndEqualsTheWholeComputation) {
  PlanFields plan = head.Plan();
  plan.image_angles_deg = {0.0};
  head.SetPlan(plan);
  session.SetScan(ScanOfSession());
  head.scan();
  fake->Deliver(*ScanOfSession(), 60);
  ASSERT_TRUE(WaitFor([&] { return live.Depth() != nullptr; }));
  fake->Deliver(*ScanOfSession(), 100);
  ASSERT_TRUE(WaitFor([&] { return live.Lines() == 100; }));
  const auto options =
      FixedForPlan(DefaultsOf(LiveDepthViewModel::Method()), head.Plan().ToPlan(), session.Rig());
  ASSERT_TRUE(options);
  const auto whole = ComputeDepthInFrame(*session.Cloud(), session.Rig(),
                                         ScanOfSession()->frames[0], *options, {});
  ASSERT_TRUE(whole);
  EXPECT_EQ(live.Depth()->mask, whole->mask);
  EXPECT_EQ(live.Depth()->dense.confidence, whole->dense.confidence);
}

TEST_F(LiveDepthTest, AnImageOfAnotherAngleIsNotUsed) {
  PlanFields plan = head.Plan();
  plan.image_angles_deg = {5.0};
  head.SetPlan(plan);
  session.SetScan(ScanOfSession());
  head.scan();
  fake->Deliver(*ScanOfSession(), 60);
  ASSERT_TRUE(WaitFor([&] { return session.Cloud() != nullptr; }));
  EXPECT_FALSE(live.Runner()->Busy());
}

/// A wheel with two alternatives, found in the shared scan.
FoundObject ValveWithTwoAlternatives() {
  ValveDetection valve;
  valve.verdict = {VerdictLevel::kConfirmed, 0.97, "a valve", {}};
  valve.alternatives.resize(2);
  FoundObject object;
  object.detection = valve;
  object.scan_uuid = ScanOfSession()->uuid;
  return object;
}

TEST_F(SessionTest, TabGoesThroughTheAnswersRoundAndRound) {
  session.AddObject(ValveWithTwoAlternatives());
  int changes = 0;
  QObject::connect(&session, &SessionModel::objectsChanged, [&] { ++changes; });
  for (const int expected : {1, 2, 0}) {
    session.nextCandidate();
    EXPECT_EQ(session.Candidate(), expected);
  }
  session.previousCandidate();
  EXPECT_EQ(session.Candidate(), 2);
  EXPECT_EQ(changes, 4);
}

TEST_F(SessionTest, AnotherObjectIsShownWithItsBestAnswer) {
  session.AddObject(ValveWithTwoAlternatives());
  session.nextCandidate();
  session.AddObject(ValveWithTwoAlternatives());
  EXPECT_EQ(session.Candidate(), 0);
  EXPECT_EQ(session.CandidateOf(0), 0);
}

TEST_F(SessionTest, ADecisionIsKeptAndCanBeTakenBack) {
  session.AddObject(ValveWithTwoAlternatives());
  std::vector<ObjectEvent> events;
  QObject::connect(&session, &SessionModel::objectTouched,
                   [&](const ObjectEvent& event) { events.push_back(event); });
  session.Decide(Decision::kAccepted);
  EXPECT_EQ(session.Objects()[0].decision, Decision::kAccepted);
  session.Undo()->undo();
  EXPECT_EQ(session.Objects()[0].decision, Decision::kOpen);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].action, DetectionEvent::Action::kAccepted);
  EXPECT_EQ(events[1].action, DetectionEvent::Action::kReopened);
}

TEST_F(SessionTest, ADecisionSaysWhichAnswerItIsAboutWhereItIsNotTheBestOne) {
  session.AddObject(ValveWithTwoAlternatives());
  QString text;
  QObject::connect(&session, &SessionModel::objectTouched,
                   [&](const ObjectEvent& event) { text = event.text; });
  session.nextCandidate();
  session.Decide(Decision::kAccepted);
  EXPECT_EQ(text.toStdString(), "answer 2");
}

TEST_F(SessionTest, AnAcceptedAlternativeStaysTheAnswerThatStandsForTheObject) {
  session.AddObject(ValveWithTwoAlternatives());
  session.nextCandidate();
  session.Decide(Decision::kAccepted);
  session.RemoveSelected();
  session.Undo()->undo();
  EXPECT_EQ(session.Candidate(), 1) << "what was accepted is shown, and not the best answer";
  EXPECT_EQ(session.Objects()[0].decided_candidate, 1);
  session.AddObject(ValveWithTwoAlternatives());
  EXPECT_EQ(session.CandidateOf(0), 1) << "it is drawn, too";
  session.Undo()->undo();
  EXPECT_EQ(session.Objects()[0].decision, Decision::kOpen);
  session.Undo()->redo();
  session.SelectObject(0);
  EXPECT_EQ(session.Candidate(), 1);
}

TEST_F(SessionTest, AcceptingWhatIsUnsureIsPossibleAndSaidOnce) {
  FoundObject valve = ValveWithTwoAlternatives();
  std::get<ValveDetection>(valve.detection).verdict = {
      VerdictLevel::kUnsure, 0.3, "Little of the rim is seen.", {}};
  session.AddObject(valve);
  notices.clear();
  QStringList over;
  QObject::connect(&session, &SessionModel::settled, [&](const QString& topic) { over << topic; });
  session.Decide(Decision::kAccepted);
  EXPECT_EQ(session.Objects()[0].decision, Decision::kAccepted);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].what.toStdString(), "Accepted although UNSURE: Little of the rim is seen.");
  over.clear();
  session.Undo()->undo();
  EXPECT_TRUE(over.contains(notices[0].topic)) << "it was taken back";
  session.Undo()->redo();
  EXPECT_EQ(notices.size(), 2u) << "it is accepted again";
  session.AddObject(ValveWithTwoAlternatives());
  over.clear();
  session.Decide(Decision::kRejected);
  EXPECT_FALSE(over.contains(notices[0].topic)) << "that is another object";
}

TEST_F(SessionTest, AnUnsureAnswerAsLikelyAsTheBestOneIsWarnedOfWithTheBestOnesReason) {
  FoundObject valve = ValveWithTwoAlternatives();
  auto& found = std::get<ValveDetection>(valve.detection);
  found.verdict = {VerdictLevel::kUnsure, 0.3, "Little of the rim is seen.", {}};
  found.alternatives[0].log_likelihood = found.best.log_likelihood;
  found.alternatives[1].log_likelihood = found.best.log_likelihood - 275.0;
  session.AddObject(valve);
  notices.clear();
  session.nextCandidate();
  session.Decide(Decision::kAccepted);
  session.nextCandidate();
  session.Decide(Decision::kAccepted);
  session.Decide(Decision::kOpen);
  EXPECT_EQ(session.Objects()[0].decided_candidate, 0);
  ASSERT_EQ(notices.size(), 2u);
  EXPECT_EQ(notices[0].what.toStdString(), "Accepted although UNSURE: Little of the rim is seen.");
  EXPECT_EQ(notices[1].what.toStdString(),
            "Accepted although UNSURE: the best answer explains the measurements better.");
}

TEST_F(SessionTest, ADeletedObjectComesBackWhereItWas) {
  session.AddObject(ValveWithTwoAlternatives());
  session.AddObject(ValveWithTwoAlternatives());
  const std::string first = session.Objects()[0].uuid;
  session.SelectObject(0);
  session.RemoveSelected();
  ASSERT_EQ(session.Objects().size(), 1u);
  session.Undo()->undo();
  ASSERT_EQ(session.Objects().size(), 2u);
  EXPECT_EQ(session.Objects()[0].uuid, first);
}

TEST_F(SessionTest, ACopyIsAnObjectOfItsOwnThatIsNotDecidedOn) {
  session.AddObject(ValveWithTwoAlternatives());
  session.Decide(Decision::kAccepted);
  session.CopySelected();
  ASSERT_EQ(session.Objects().size(), 2u);
  EXPECT_NE(session.Objects()[1].uuid, session.Objects()[0].uuid);
  EXPECT_EQ(session.Objects()[1].decision, Decision::kOpen);
}

TEST_F(SessionTest, TheCopyOfAnObjectThatWasSentWasNotSent) {
  FoundObject sent = ValveWithTwoAlternatives();
  sent.robot = QStringLiteral("accepted");
  sent.sendings = 1;
  session.AddObject(sent);
  session.CopySelected();
  ASSERT_EQ(session.Objects().size(), 2u);
  EXPECT_TRUE(session.Objects()[1].robot.isEmpty());
  EXPECT_EQ(session.Objects()[1].sendings, 0);
}

TEST_F(SessionTest, TerrainIsComparedWithTheLastAcceptedOneOnly) {
  const auto terrain_of_another_scan = [] {
    FoundObject object;
    TerrainDetection terrain;
    terrain.verdict.level = VerdictLevel::kConfirmed;
    object.detection = terrain;
    object.scan_uuid = "another";
    return object;
  };
  session.SetScan(ScanOfSession());
  session.AddObject(terrain_of_another_scan());
  const auto last = [&] {
    return std::get<FitTerrainOptions>(fit.OptionsFor(ObjectKind::kTerrain)).last;
  };
  EXPECT_EQ(last(), nullptr);
  session.Decide(Decision::kAccepted);
  EXPECT_NE(last(), nullptr);
  session.Decide(Decision::kRejected);
  EXPECT_EQ(last(), nullptr);
}

TEST_F(SessionTest, WithoutAnObjectThereIsNoAnswerToStepTo) {
  session.nextCandidate();
  EXPECT_EQ(session.Candidate(), 0);
  EXPECT_EQ(session.Selected(), nullptr);
}

TEST(RegionThrough, TwoPointsAreARectangleOrACircleAndManyAPolygon) {
  const std::vector<Eigen::Vector2d> two = {{10, 20}, {50, 60}};
  EXPECT_EQ(RegionThrough(RegionShape::kRectangle, 0.1, two)->polygon.size(), 4U);
  const auto circle = RegionThrough(RegionShape::kTwoClicks, 0.1, two);
  ASSERT_TRUE(circle);
  EXPECT_TRUE(circle->Contains({30, 40}));
  EXPECT_TRUE(circle->Contains({8, 18})) << "three tenths wider than the clicks are apart";
  const auto triangle = RegionThrough(RegionShape::kPolygon, 0.1, {{0, 0}, {40, 0}, {0, 40}});
  ASSERT_TRUE(triangle);
  EXPECT_EQ(triangle->polygon.size(), 3U);
  EXPECT_EQ(triangle->motor_rad, 0.1);
  EXPECT_FALSE(RegionThrough(RegionShape::kPolygon, 0.1, two));
}

}  // namespace
}  // namespace foresight
