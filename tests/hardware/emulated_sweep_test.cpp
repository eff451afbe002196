// The whole way: three emulators, three real drivers, one head, in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/registration/register_scan.h"
#include "hardware/assembly/real_head.h"
#include "hardware/scip/scip_lidar.h"
#include "tests/hardware/emulated_head.h"
#include "tests/hardware/small_sweep.h"

namespace foresight {
namespace {

/// What the simulation in this process would have brought home from the same turns of the mirror.
Scan SimulatedTwin(const Scan& scan, const EmulatedDevices& devices) {
  Scan twin = scan;
  twin.track = MotorTrack();
  const double first_s = scan.track.samples().front().time_s;
  const double last_s = scan.track.samples().back().time_s;
  for (double time_s = first_s; time_s < last_s; time_s += 1.0 / SimulatedMotor::kSampleRate_hz)
    twin.track.Add({time_s, devices.world()->EncoderAngle(devices.ShaftAngle(time_s))});
  twin.lines.clear();
  for (const LidarLine& line : scan.lines)
    twin.lines.push_back(devices.MeasureTurn(EmulatedHead::TurnOf(line)));
  return twin;
}

/// One sweep for all tests: it takes its real time.
class EmulatedSweep : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    bench_ = std::make_unique<EmulatedHead>(FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml");
    scan_ = bench_->Execute(SmallSweep());
  }
  static void TearDownTestSuite() {
    scan_.reset();
    bench_.reset();
  }
  void SetUp() override {
    ASSERT_TRUE(scan_) << bench_->head->Status().message;
    ASSERT_EQ(scan_->state, ScanState::kComplete) << scan_->reason;
  }

  static inline std::unique_ptr<EmulatedHead> bench_;
  static inline std::shared_ptr<const Scan> scan_;
};

TEST_F(EmulatedSweep, BringsFortyLinesASecondAndLosesNone) {
  // 20 deg at 10 deg/s; a line before and one behind the scope belong to it.
  EXPECT_NEAR(static_cast<double>(scan_->lines.size()), 81.0, 2.0);
  for (std::size_t i = 1; i < scan_->lines.size(); ++i)
    EXPECT_EQ(scan_->lines[i].seq, scan_->lines[i - 1].seq + 1);
  EXPECT_EQ(bench_->head->Status().lost_lines, 0);
}

TEST_F(EmulatedSweep, LinesAreThoseOfTheSimulationInThisProcess) {
  for (const LidarLine& line : scan_->lines) {
    const LidarLine truth = bench_->devices->MeasureTurn(EmulatedHead::TurnOf(line));
    EXPECT_EQ(line.range_mm, truth.range_mm);
    EXPECT_EQ(line.intensity, truth.intensity);
    EXPECT_NEAR(line.time_s, truth.time_s, 1e-3);  // the device's clock counts milliseconds
  }
}

TEST_F(EmulatedSweep, PointsAreThoseOfTheSimulationInThisProcess) {
  const RegisteredScan wired = RegisterScan(*scan_, RunContext()).value();
  const RegisteredScan twin =
      RegisterScan(SimulatedTwin(*scan_, *bench_->devices), RunContext()).value();
  // The zero comes from a switch (0.003 deg, five sigma), the stamps from a clock of 1 ms at
  // 10 deg/s, the angles from counts of 0.02 deg.
  const double angle_rad = RadiansFromDegrees(0.015 + 0.010 + 0.005);
  int compared = 0;
  for (std::size_t i = 0; i < wired.points.size(); ++i) {
    ASSERT_EQ(std::isnan(wired.range_m[i]), std::isnan(twin.range_m[i]));
    if (std::isnan(wired.range_m[i])) continue;
    ++compared;
    EXPECT_LT((wired.points[i] - twin.points[i]).norm(), angle_rad * (wired.range_m[i] + 0.1));
  }
  EXPECT_GT(compared, wired.lines * wired.beams / 2);
}

TEST_F(EmulatedSweep, TheImageIsTheOneThatWasTakenAtTheAngle) {
  ASSERT_EQ(scan_->frames.size(), 1u);
  const CameraFrame& frame = scan_->frames.front();
  EXPECT_NEAR(DegreesFromRadians(frame.motor_angle_rad), -15.0, 0.1);
  const auto taken = bench_->devices->camera().taken();
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_NEAR(frame.time_s, taken[0].middle_s, 2e-3);
  EXPECT_NEAR(frame.motor_angle_rad, bench_->devices->ShaftAngle(taken[0].middle_s),
              RadiansFromDegrees(0.05));
  EXPECT_EQ(frame.image.width(), bench_->config.rig.camera.width);
}

TEST_F(EmulatedSweep, TheMotorStandsStillWhenTheSweepIsOver) {
  EXPECT_FALSE(bench_->devices->MotorTurns());
  EXPECT_EQ(bench_->head->Status().state, HeadState::kReady);
}

}  // namespace
}  // namespace foresight
