#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using testing::HasSubstr;

double Degrees(double radians) {
  return DegreesFromRadians(radians);
}

/// The motor's angle at a line's first and last beam.
std::pair<double, double> LineAngles(const Scan& scan, const LidarLine& line) {
  const LidarModel& lidar = scan.rig.lidar;
  return {scan.track.AngleAt(line.time_s + lidar.BeamTime(0)),
          scan.track.AngleAt(line.time_s + lidar.BeamTime(lidar.beams - 1))};
}

TEST(CaptureHead, RefusesToScanBeforeHoming) {
  const TinyHead tiny;
  const auto status = tiny.head->StartScan(TinyPlan(), tiny.sinks);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kState);
  EXPECT_THAT(status.error().message, HasSubstr("cannot scan while disconnected: home it first"));
}

TEST(CaptureHead, IsReadyAtZeroAfterHoming) {
  const TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  EXPECT_EQ(tiny.shaft->At(tiny.clock->Now()).angle_rad, 0.0);
  EXPECT_EQ(tiny.head->Status().message, "");
}

TEST(CaptureHead, RefusesABadPlan) {
  const TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  ScanPlan plan = TinyPlan();
  plan.speed_rad_s = -1.0;
  EXPECT_EQ(tiny.head->StartScan(plan, tiny.sinks).error().code, ErrorCode::kInvalidOptions);
}

TEST(CaptureHead, ASweepBringsTheExpectedLines) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  // A second at 40 Hz; the scope's ends cut a line each or not, and one is added on each side.
  EXPECT_GE(scan->lines.size(), 40u);
  EXPECT_LE(scan->lines.size(), 42u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  const HeadStatus status = tiny.head->Status();
  EXPECT_EQ(status.expected_lines, 42);
  EXPECT_EQ(status.lines, static_cast<int>(scan->lines.size()));
  EXPECT_EQ(status.frames, 1);
  EXPECT_EQ(status.lost_lines, 0);
  EXPECT_TRUE(tiny.AtRest());
}

TEST(CaptureHead, LinesLieInTheScopeButForOneOnEachSide) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  const auto& lines = scan->lines;
  for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
    const auto [first, last] = LineAngles(*scan, lines[i]);
    EXPECT_GE(Degrees(first), -5.0) << i;
    EXPECT_LE(Degrees(last), 5.0) << i;
  }
  EXPECT_LT(Degrees(LineAngles(*scan, lines.front()).first), -5.0);
  EXPECT_GT(Degrees(LineAngles(*scan, lines.back()).second), 5.0);
}

TEST(CaptureHead, TheSpeedIsConstantInTheScope) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  for (std::size_t i = 1; i < scan->lines.size(); ++i) {
    const double step =
        LineAngles(*scan, scan->lines[i]).first - LineAngles(*scan, scan->lines[i - 1]).first;
    // 0.25 deg a line; the fit through about ten samples leaves a third of the encoder's 0.02 deg.
    EXPECT_NEAR(Degrees(step), 0.25, 0.015) << i;
  }
}

TEST(CaptureHead, SweepsDownwardsToo) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  ScanPlan plan = TinyPlan();
  std::swap(plan.from_rad, plan.to_rad);
  const auto scan = tiny.Run(plan);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_GE(scan->lines.size(), 40u);
  EXPECT_GT(LineAngles(*scan, scan->lines.front()).first,
            LineAngles(*scan, scan->lines.back()).first);
}

TEST(CaptureHead, TheFastestWidestSweepIsPossible) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  ScanPlan plan;
  plan.from_rad = ScanPlan::kMinAngle_rad;
  plan.to_rad = ScanPlan::kMaxAngle_rad;
  plan.speed_rad_s = ScanPlan::kMaxSpeed_rad_s;
  const auto scan = tiny.Run(plan);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
}

TEST(CaptureHead, ImagesAreTakenAtTheirAngles) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  ScanPlan plan = TinyPlan();
  plan.image_angles_rad.clear();
  for (const double degrees : {5.0, -5.0, 0.0, 0.05, 2.5})
    plan.image_angles_rad.push_back(RadiansFromDegrees(degrees));
  const auto scan = tiny.Run(plan);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->frames.size(), 5u);
  for (const CameraFrame& frame : scan->frames) {
    // The encoder's step is 0.02 deg.
    EXPECT_NEAR(Degrees(frame.motor_angle_rad), Degrees(frame.target_angle_rad), 0.03);
    EXPECT_EQ(frame.motor_angle_rad, scan->track.AngleAt(frame.time_s));
    EXPECT_EQ(frame.image.width(), 32);
  }
  EXPECT_NEAR(Degrees(scan->frames.front().target_angle_rad), -5.0, 1e-9);
}

TEST(CaptureHead, TheSameHeadMeasuresTheSameScanAgain) {
  TinyHead first, second;
  ASSERT_TRUE(first.Home());
  ASSERT_TRUE(second.Home());
  const auto a = first.Run(TinyPlan());
  const auto b = second.Run(TinyPlan());
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->lines, b->lines);
  EXPECT_EQ(a->track, b->track);
  EXPECT_EQ(a->frames, b->frames);
}

TEST(CaptureHead, AnAbortKeepsTheLinesAndStopsTheMotor) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.head->AbortScan(); };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kAborted);
  EXPECT_EQ(scan->reason, "the operator ended the scan");
  EXPECT_GE(scan->lines.size(), 10u);
  EXPECT_LT(scan->lines.size(), 20u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_TRUE(tiny.AtRest());
  EXPECT_LT(Degrees(tiny.shaft->At(tiny.clock->Now()).angle_rad), 0.0);
}

TEST(CaptureHead, StoppingTheMotorEndsTheScan) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.head->StopMotor(); };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kAborted);
  EXPECT_EQ(scan->reason, "the operator stopped the motor");
  EXPECT_TRUE(tiny.AtRest());
}

TEST(CaptureHead, CanScanAgainAfterAnAbort) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.head->AbortScan(); };
  ASSERT_TRUE(tiny.Run(TinyPlan()));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  const auto assembler = std::make_shared<ScanAssembler>();
  ASSERT_TRUE(tiny.head->StartScan(TinyPlan(), assembler));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(assembler->Snapshot()->state, ScanState::kComplete);
}

TEST(CaptureHead, ASecondScanIsRefusedWhileOneRuns) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  Status second, homing;
  tiny.watch->action = [&] {
    second = tiny.head->StartScan(TinyPlan(), tiny.sinks);
    homing = tiny.head->Home();
  };
  ASSERT_TRUE(tiny.Run(TinyPlan()));
  EXPECT_EQ(second.error().code, ErrorCode::kState);
  EXPECT_EQ(homing.error().code, ErrorCode::kState);
}

/// A device failed: the scan is interrupted, the motor at rest, and the operator told what to do.
void ExpectFault(TinyHead& tiny, const std::shared_ptr<const Scan>& scan, const char* what) {
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, HasSubstr(what));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr(what));
  EXPECT_THAT(tiny.head->Status().message,
              HasSubstr("the motor was told to stop. See that it stands"));
  EXPECT_GT(tiny.motor->quick_stops, 0);
  tiny.clock->Sleep(std::chrono::seconds(1));  // longer than any braking
  EXPECT_TRUE(tiny.AtRest());
}

TEST(CaptureHead, ALostLidarStopsTheMotor) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.lidar->tamper = [n = 0](TamperedLidar::Answer answer) mutable -> TamperedLidar::Answer {
    if (++n > 20) return Fail(ErrorCode::kDevice, "test lidar: connection reset");
    return answer;
  };
  const auto scan = tiny.Run(TinyPlan());
  ExpectFault(tiny, scan, "test lidar: connection reset");
}

TEST(CaptureHead, ASilentLidarStopsTheMotor) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.lidar->tamper = [n = 0](TamperedLidar::Answer answer) mutable -> TamperedLidar::Answer {
    if (++n > 20) return std::nullopt;
    return answer;
  };
  const auto scan = tiny.Run(TinyPlan());
  ExpectFault(tiny, scan, "test lidar: no line for 15");
}

TEST(CaptureHead, AMotorFaultEndsTheScan) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.motor->failing = true; };
  const auto scan = tiny.Run(TinyPlan());
  ExpectFault(tiny, scan, "following error 8611h");
  EXPECT_GE(scan->lines.size(), 10u);
}

TEST(CaptureHead, AMotorThatStopsByItselfIsNoticed) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.shaft->Stop(tiny.clock->Now(), 1000.0); };
  const auto scan = tiny.Run(TinyPlan());
  ExpectFault(tiny, scan, "before the end of the scope");
}

TEST(CaptureHead, ACameraThatNeverDeliversCostsTheImagesNotTheLines) {
  TinyHead tiny(
      [](HeadDevices& devices) { devices.camera = std::make_unique<SilentCamera>(devices.clock); });
  ASSERT_TRUE(tiny.Home());
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_EQ(scan->reason, "the image at 0.00 deg did not come: test camera: is silent");
  EXPECT_GE(scan->lines.size(), 40u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(tiny.head->Status().message, scan->reason);
}

TEST(CaptureHead, ASinkThatThrowsEndsTheScanNotTheProgram) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [] { throw std::runtime_error("the sink is broken"); };
  const auto scan = tiny.Run(TinyPlan());
  ExpectFault(tiny, scan, "the sink is broken");
}

TEST(CaptureHead, AMotorLostBetweenScansIsAFault) {
  const TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.motor->failing = true;
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr("following error"));
}

TEST(CaptureHead, HomingLeadsOutOfAFault) {
  const TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.motor->failing = true;
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  tiny.motor->failing = false;
  EXPECT_TRUE(tiny.Home());
}

TEST(CaptureHead, CountsLostLines) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.lidar->tamper = [n = 0](TamperedLidar::Answer answer) mutable -> TamperedLidar::Answer {
    if (answer && *answer && ++n > 20) (*answer)->seq += 3;
    return answer;
  };
  ASSERT_TRUE(tiny.Run(TinyPlan()));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(tiny.head->Status().lost_lines, 3);
}

TEST(CaptureHead, ItsDestructorStopsTheMotorDuringASweep) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  std::promise<void> sweeping;
  tiny.watch->action = [&] {
    // Holds the sweep until the destructor has stopped the motor.
    const int before = tiny.motor->quick_stops;
    sweeping.set_value();
    while (tiny.motor->quick_stops == before) std::this_thread::yield();
  };
  ASSERT_TRUE(tiny.head->StartScan(TinyPlan(), tiny.sinks));
  sweeping.get_future().wait();
  tiny.head.reset();
  EXPECT_TRUE(tiny.AtRest());
  const auto scan = tiny.assembler->Snapshot();
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_EQ(scan->reason, "the head was switched off");
  EXPECT_GE(scan->lines.size(), 10u);
}

TEST(CaptureHead, AScanAcceptedJustBeforeTheDestructorStillEnds) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  ASSERT_TRUE(tiny.head->StartScan(TinyPlan(), tiny.sinks));
  tiny.head.reset();
  EXPECT_TRUE(tiny.watch->WaitForEnd());
}

TEST(CaptureHead, SnapshotsMayBeTakenWhileTheScanArrives) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  // The head waits at the scan's tenth line until a snapshot has been taken.
  std::atomic<bool> taken = false;
  tiny.watch->action = [&taken] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!taken && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  };
  ASSERT_TRUE(tiny.head->StartScan(TinyPlan(), tiny.sinks));
  std::size_t least = 1000, last = 0;
  while (tiny.head->Status().state != HeadState::kReady) {
    const auto snapshot = tiny.assembler->Snapshot();
    if (!snapshot) continue;
    EXPECT_GE(snapshot->lines.size(), last);
    last = snapshot->lines.size();
    least = std::min(least, snapshot->lines.size());
    taken = true;
  }
  EXPECT_LE(least, 10u) << "none was taken while the scan arrived";
  EXPECT_GE(tiny.assembler->Snapshot()->lines.size(), 40u);
}

}  // namespace
}  // namespace foresight
