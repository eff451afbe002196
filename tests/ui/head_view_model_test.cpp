#include "ui/viewmodels/head_view_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/depth/depth_method.h"
#include "core/depth/local_plane.h"
#include "core/sensor/rig_id.h"
#include "tests/ui/fake_head.h"
#include "tests/ui/synthetic_scan.h"

namespace foresight {
namespace {

struct HeadTest : testing::Test {
  std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>(DefaultSensorRig());
  HeadViewModel model{head};

  void SetSpeed(double deg_s) {
    PlanFields plan = model.Plan();
    plan.speed_deg_s = deg_s;
    model.SetPlan(plan);
  }
};

TEST_F(HeadTest, SaysWhichRigIsInForceAndItsCameraModel) {
  EXPECT_EQ(model.RigText().toStdString(),
            "Rig default, " + ShortRigId(DefaultSensorRig()) + "\nCamera model: fisheye with k");
}

TEST_F(HeadTest, PredictionFollowsTheSpeed) {
  SetSpeed(10.0);
  EXPECT_EQ(model.Prediction().time.toStdString(), "6.0 s");
  SetSpeed(20.0);
  EXPECT_EQ(model.Prediction().time.toStdString(), "3.0 s");
  EXPECT_EQ(model.Prediction().lines.toStdString(), "121");
}

TEST_F(HeadTest, WarnsUnderTheFloorOfTwoPercentAndSaysHowFastToScan) {
  SetSpeed(100.0);
  const PredictionText fast = model.Prediction();
  ASSERT_FALSE(fast.warning.isEmpty());
  EXPECT_TRUE(fast.usable);
  const ScanPlan plan = model.Plan().ToPlan();
  const double density = PredictScan(plan, head->Rig())->density;
  const double advised = std::floor(10.0 * 100.0 * density / 0.02) / 10.0;
  SetSpeed(advised);
  EXPECT_TRUE(model.Prediction().warning.isEmpty()) << advised << " deg/s";
}

TEST_F(HeadTest, TheFastestSpeedIsTakenOverAndKeepsTheFloor) {
  SetSpeed(100.0);
  const double fastest = model.Prediction().fastest_deg_s;
  model.useFastestSpeed();
  EXPECT_EQ(model.Plan().speed_deg_s, fastest);
  EXPECT_TRUE(model.Prediction().warning.isEmpty());
  EXPECT_LT(fastest, 100.0);
}

TEST_F(HeadTest, APlanForImagesStandingStillThereAndBack) {
  PlanFields plan = model.Plan();
  plan.standing_still = plan.there_and_back = true;
  model.SetPlan(plan);
  EXPECT_EQ(plan.ToPlan().image_mode, ScanPlan::ImageMode::kStopAndShoot);
  EXPECT_EQ(plan.ToPlan().passes, 2);
  EXPECT_EQ(model.Prediction().lines.toStdString(), "482");
}

TEST_F(HeadTest, AnExposureThatWouldBlurIsShortenedAndSaysSo) {
  PlanFields plan = model.Plan();
  plan.exposure_ms = 50.0;
  model.SetPlan(plan);
  EXPECT_TRUE(model.Prediction().exposure.contains("shortened"));
  plan.standing_still = true;
  model.SetPlan(plan);
  EXPECT_EQ(model.Prediction().exposure.toStdString(), "50.0 ms");
}

TEST_F(HeadTest, AnImpossiblePlanNamesItsFaultAndCannotBeScanned) {
  PlanFields plan = model.Plan();
  plan.image_angles_deg = {80.0};
  model.SetPlan(plan);
  EXPECT_TRUE(model.Prediction().warning.contains("image at 80.0 deg"));
  EXPECT_FALSE(model.CanScan());
}

TEST_F(HeadTest, EveryPollTellsTheHeadThatTheOperatorIsThere) {
  const int before = head->TimesOperatorSeen();
  model.Poll();
  EXPECT_EQ(head->TimesOperatorSeen(), before + 1);
}

TEST_F(HeadTest, AbortIsPossibleOnlyWhileSweeping) {
  for (const HeadState state : {HeadState::kDisconnected, HeadState::kHoming, HeadState::kReady,
                                HeadState::kStopping, HeadState::kFault}) {
    head->SetState(state);
    model.Poll();
    EXPECT_FALSE(model.CanAbort()) << ToString(state);
  }
  head->SetState(HeadState::kSweeping);
  model.Poll();
  EXPECT_TRUE(model.CanAbort());
}

TEST_F(HeadTest, ThePlanCannotBeEditedWhileTheHeadMoves) {
  for (const HeadState state : {HeadState::kHoming, HeadState::kSweeping, HeadState::kStopping}) {
    head->SetState(state);
    model.Poll();
    EXPECT_FALSE(model.CanEditPlan()) << ToString(state);
  }
  for (const HeadState state : {HeadState::kDisconnected, HeadState::kReady, HeadState::kFault}) {
    head->SetState(state);
    model.Poll();
    EXPECT_TRUE(model.CanEditPlan()) << ToString(state);
  }
}

TEST_F(HeadTest, TheFilterRadiusIsThatOfTheMethodThatWillRun) {
  SetSpeed(12.0);
  const double density = PredictScan(model.Plan().ToPlan(), head->Rig())->density;
  const PredictionText text = model.Prediction();
  EXPECT_EQ(text.sigma, QStringLiteral("%1 px").arg(LocalPlaneSigmaForDensity(density), 0, 'f', 1));
  EXPECT_EQ(text.method.toStdString(), DepthMethods().front().title);
}

TEST_F(HeadTest, DevicesAreNotCalledMissingBeforeTheHeadIsConnected) {
  head->SetState(HeadState::kDisconnected);
  model.Poll();
  ASSERT_EQ(model.Devices().size(), 3);
  EXPECT_EQ(model.Devices()[0].state.toStdString(), "not connected yet");
  EXPECT_EQ(model.Devices()[0].lamp, DeviceRow::Lamp::kIdle);
}

TEST_F(HeadTest, DeviceRowsSayHowTheDevicesDoAndWhatIsWrong) {
  HeadHealth health;
  health.lidar.connected = health.motor.connected = true;
  health.lidar.line_rate_hz = 40.0;
  health.lidar.lost_lines = 3;
  health.motor.poll_rate_hz = 240.0;
  health.camera.last_error = "camera 10.0.0.3: does not answer";
  head->SetHealth(health);
  model.Poll();
  const QVector<DeviceRow> rows = model.Devices();
  EXPECT_EQ(rows[0].state.toStdString(), "degraded");
  EXPECT_EQ(rows[0].detail.toStdString(),
            "40 lines/s, 3 lost, clock offset 0.000 s\nlines lost: 3");
  EXPECT_EQ(rows[1].state.toStdString(), "missing");
  EXPECT_EQ(rows[1].detail.toStdString(), "not connected: camera 10.0.0.3: does not answer");
  EXPECT_EQ(rows[2].state.toStdString(), "well");
  EXPECT_EQ(rows[2].detail.toStdString(), "240 polls/s, round trip 0.00 ms");
}

TEST_F(HeadTest, SendsThePlanInRadians) {
  SetSpeed(12.0);
  model.scan();
  EXPECT_NEAR(head->LastPlan().speed_rad_s, 12.0 * M_PI / 180.0, 1e-12);
}

TEST_F(HeadTest, ARefusedScanIsReportedAndNotCountedAsRunning) {
  Notice notice;
  QObject::connect(&model, &HeadViewModel::noticed, [&](const Notice& n) { notice = n; });
  head->SetState(HeadState::kFault);
  model.scan();
  EXPECT_FALSE(model.Scanning());
  EXPECT_EQ(notice.level, Notice::Level::kError);
  EXPECT_FALSE(notice.next.isEmpty());
}

TEST_F(HeadTest, HandsOverTheScanWhenItEnds) {
  const Scan source = WallAndValveScan({.from_rad = -0.05, .to_rad = 0.05});
  std::shared_ptr<const Scan> brought;
  QObject::connect(&model, &HeadViewModel::scanEnded,
                   [&](const std::shared_ptr<const Scan>& scan) { brought = scan; });
  model.scan();
  head->Deliver(source, source.lines.size());
  model.Poll();
  EXPECT_EQ(brought, nullptr);
  head->Finish(source, ScanState::kComplete);
  model.Poll();
  ASSERT_NE(brought, nullptr);
  EXPECT_EQ(brought->lines, source.lines);
  EXPECT_EQ(brought->frames.size(), source.frames.size());
}

TEST_F(HeadTest, AfterAStopNothingMovesUntilItIsReleased) {
  model.stop();
  EXPECT_TRUE(model.StopLatched());
  EXPECT_FALSE(model.CanScan());
  EXPECT_FALSE(model.CanHome());
  model.scan();
  EXPECT_FALSE(model.Scanning());
  model.releaseStop();
  EXPECT_TRUE(model.CanScan());
  EXPECT_TRUE(model.CanHome());
}

TEST_F(HeadTest, APollThatBringsNothingNewSaysNothing) {
  model.Poll();
  int signals_heard = 0;
  QObject::connect(&model, &HeadViewModel::statusChanged, [&] { ++signals_heard; });
  for (int poll = 0; poll < 10; ++poll) model.Poll();
  EXPECT_EQ(signals_heard, 0);
  head->SetState(HeadState::kFault);
  model.Poll();
  EXPECT_EQ(signals_heard, 1);
}

TEST_F(HeadTest, AnAngleBeyondTheRangeStaysAsItWasTypedAndIsNamed) {
  PlanFields plan = model.Plan();
  plan.to_deg = 100.0;
  model.SetPlan(plan);
  EXPECT_EQ(model.Plan().to_deg, 100.0);
  EXPECT_FALSE(model.Prediction().usable);
  EXPECT_TRUE(model.Prediction().warning.contains("100"))
      << model.Prediction().warning.toStdString();
}

TEST_F(HeadTest, StopReachesTheMotorInEveryState) {
  head->SetState(HeadState::kSweeping);
  model.stop();
  EXPECT_TRUE(head->Stopped());
}

TEST_F(HeadTest, AnImageIsHandedOnAtTheNextPoll) {
  const Scan scan = WallAndValveScan(
      {.from_rad = -0.02, .to_rad = 0.02, .speed_rad_s = 0.1, .image_angles_rad = {0.0}});
  std::size_t images = 0;
  QObject::connect(&model, &HeadViewModel::scanGrew, [&](const std::shared_ptr<const Scan>& grown) {
    images = grown->frames.size();
  });
  model.scan();
  head->Deliver(scan, 3);
  // Whatever the count of polls until the next look at the lines is.
  for (int polls_before = 0; polls_before < 3; ++polls_before) {
    model.Poll();
    head->DeliverFrame(scan.frames.at(0));
    model.Poll();
    EXPECT_EQ(images, static_cast<std::size_t>(polls_before + 1));
  }
}

}  // namespace
}  // namespace foresight
