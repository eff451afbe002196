#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hardware/simulated/simulated_head.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

TEST(MotionProfile, ArrivesAtTheTargetAtRest) {
  const auto move = MotionProfile::Move(1.0, {0.5, 0.0}, -0.3, 0.2, 7.0);
  EXPECT_EQ(move.At(move.end_s()).angle_rad, -0.3);
  EXPECT_EQ(move.At(move.end_s()).speed_rad_s, 0.0);
  // 0.8 rad at 0.2 rad/s, and one ramp's time more.
  EXPECT_NEAR(move.end_s() - 1.0, 0.8 / 0.2 + 0.2 / 7.0, 1e-12);
}

TEST(MotionProfile, NeverExceedsSpeedOrAcceleration) {
  const auto move = MotionProfile::Move(0.0, {0.0, 0.9}, -1.0, 0.5, 2.0);
  double last_speed = 0.9;
  for (double t = 0.001; t < move.end_s(); t += 0.001) {
    const double speed = move.At(t).speed_rad_s;
    EXPECT_LE(std::abs(speed - last_speed), 2.0 * 0.001 + 1e-9) << t;
    EXPECT_GE(speed, -0.5 - 1e-9);
    last_speed = speed;
  }
}

TEST(MotionProfile, AShortWayIsATriangle) {
  const auto move = MotionProfile::Move(0.0, {0.0, 0.0}, 0.01, 10.0, 1.0);
  EXPECT_NEAR(move.end_s(), 0.2, 1e-12);  // 2 sqrt(0.01 / 1)
  EXPECT_NEAR(move.At(0.1).angle_rad, 0.005, 1e-12);
}

TEST(MotionProfile, AMoveToWhereItIsTakesNoTime) {
  const auto move = MotionProfile::Move(2.0, {0.5, 0.0}, 0.5, 1.0, 1.0);
  EXPECT_EQ(move.end_s(), 2.0);
}

TEST(SimulatedShaft, ItsPastStaysAsItWas) {
  SimulatedShaft shaft(0.0);
  shaft.Move(0.0, 1.0, 0.5, 10.0);
  const double before = shaft.At(0.7).angle_rad;
  shaft.Stop(0.8, 10.0);
  EXPECT_EQ(shaft.At(0.7).angle_rad, before);
  EXPECT_LT(shaft.At(10.0).angle_rad, 0.5);
}

TEST(SimulatedClock, FastTimePassesOnlyWhereSomebodyWaits) {
  SimulatedClock clock(SimulationSpeed::kAsFastAsPossible);
  clock.Sleep(std::chrono::seconds(3600));
  clock.WaitUntil(1.0);
  EXPECT_DOUBLE_EQ(clock.Now(), 3600.0);
}

class SimulatedDevices : public testing::Test {
 protected:
  std::shared_ptr<const World> world_ = TinyWorld();
  std::shared_ptr<SimulatedClock> clock_ =
      std::make_shared<SimulatedClock>(SimulationSpeed::kAsFastAsPossible);
  std::shared_ptr<SimulatedShaft> shaft_ = std::make_shared<SimulatedShaft>(0.2);
};

TEST_F(SimulatedDevices, TheMotorRefusesToMoveBeforeHoming) {
  SimulatedMotor motor(world_, clock_, shaft_);
  ASSERT_TRUE(motor.Connect());
  EXPECT_EQ(motor.StartMove(0.1, 0.1).error().code, ErrorCode::kState);
}

TEST_F(SimulatedDevices, AnInterruptedHomingFindsNoZero) {
  SimulatedMotor motor(world_, clock_, shaft_);
  ASSERT_TRUE(motor.Connect());
  ASSERT_TRUE(motor.StartHoming());
  clock_->Sleep(std::chrono::milliseconds(100));
  motor.QuickStop();
  clock_->Sleep(std::chrono::seconds(10));
  EXPECT_FALSE(motor.Moving().value());
  EXPECT_FALSE(motor.Homed());
}

TEST_F(SimulatedDevices, TheTrackIsSampledAt240HzInEncoderSteps) {
  SimulatedMotor motor(world_, clock_, shaft_);
  ASSERT_TRUE(motor.Connect());
  ASSERT_TRUE(motor.StartHoming());
  clock_->Sleep(std::chrono::seconds(5));
  motor.TakeTrack();
  ASSERT_TRUE(motor.StartMove(0.3, 0.2));
  clock_->Sleep(std::chrono::seconds(1));
  const auto samples = motor.TakeTrack();
  ASSERT_EQ(samples.size(), 240u);
  const double step = world_->options().motor.encoder_step_rad;
  for (const MotorSample& sample : samples) {
    EXPECT_NEAR(sample.angle_rad, shaft_->At(sample.time_s).angle_rad, 0.5 * step + 1e-12);
    EXPECT_NEAR(std::remainder(sample.angle_rad - 0.5 * step, step), 0.0, 1e-9);
  }
}

TEST_F(SimulatedDevices, TheLidarsLinesComeEveryPeriodInOrder) {
  SimulatedLidar lidar(world_, clock_, shaft_);
  ASSERT_TRUE(lidar.Start());
  for (int i = 0; i < 5; ++i) {
    const LidarLine line = lidar.WaitForLine(std::chrono::milliseconds(100)).value().value();
    EXPECT_EQ(line.seq, i);
    EXPECT_NEAR(line.time_s, 0.025 * i, 1e-12);
    EXPECT_EQ(line.range_mm.size(), 61u);
  }
}

TEST_F(SimulatedDevices, TheLidarWaitsNoLongerThanItsTimeout) {
  SimulatedLidar lidar(world_, clock_, shaft_);
  ASSERT_TRUE(lidar.Start());
  EXPECT_FALSE(lidar.WaitForLine(std::chrono::milliseconds(1)).value());
  EXPECT_NEAR(clock_->Now(), 0.001, 1e-12);
}

TEST_F(SimulatedDevices, TheCamerasFrameKnowsTheMiddleOfItsExposure) {
  SimulatedCamera camera(world_, clock_, shaft_);
  ASSERT_TRUE(camera.Configure({0.01, 3.0}));
  clock_->Sleep(std::chrono::seconds(2));
  ASSERT_TRUE(camera.Trigger());
  EXPECT_FALSE(camera.WaitForFrame(std::chrono::milliseconds(0)).value());
  const CameraFrame frame = camera.WaitForFrame(std::chrono::milliseconds(100)).value().value();
  EXPECT_NEAR(frame.time_s, 2.005, 1e-12);
  EXPECT_EQ(frame.exposure_s, 0.01);
  EXPECT_EQ(frame.gain_db, 3.0);
  EXPECT_EQ(frame.image.height(), 24);
}

TEST(SimulatedCamera, InRealTimeItRendersInItsOwnThread) {
  const auto clock = std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime);
  const auto shaft = std::make_shared<SimulatedShaft>(0.0);
  SimulatedCamera camera(TinyWorld(), clock, shaft);
  ASSERT_TRUE(camera.Trigger());
  const auto frame = camera.WaitForFrame(std::chrono::seconds(20)).value();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->image.width(), 32);
}

TEST(SimulatedHead, ScansASceneFile) {
  SimulatedHeadOptions options;
  options.true_rig = options.believed_rig = TinyRig();
  options.speed = SimulationSpeed::kAsFastAsPossible;
  const auto head =
      MakeSimulatedHead(std::string(FORESIGHT_SOURCE_DIR) + "/resources/scenes/valve.yaml", options)
          .value();
  EXPECT_EQ(head->Describe(), "simulated: valve, seed 1");
  ASSERT_TRUE(head->Home());
  while (head->Status().state == HeadState::kHoming) std::this_thread::yield();
  const auto assembler = std::make_shared<ScanAssembler>();
  const auto watch = std::make_shared<ScanWatch>();
  ASSERT_TRUE(head->StartScan(
      TinyPlan(),
      std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{assembler, watch})));
  ASSERT_TRUE(watch->WaitForEnd());
  const auto scan = assembler->Snapshot();
  EXPECT_EQ(scan->state, ScanState::kComplete);
  EXPECT_TRUE(scan->simulated);
  EXPECT_EQ(scan->source, "simulated: valve, seed 1");
}

TEST(SimulatedHead, AMissingSceneFileIsAnError) {
  EXPECT_EQ(MakeSimulatedHead(std::filesystem::path("/nowhere.yaml"), {}).error().code,
            ErrorCode::kIo);
}

}  // namespace
}  // namespace foresight
