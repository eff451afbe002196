// Captures while the head stands: at one angle after the other, an image and some lines each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class StopWatch final : public StopSink {
 public:
  void OnStop(const StopCapture& capture) override {
    captures.push_back(capture);
    if (on_stop) on_stop();
  }
  void OnStopsEnded(ScanState how, const std::string& why) override {
    state = how;
    reason = why;
    ended_.set_value();
  }
  bool WaitForEnd() {
    return ended_.get_future().wait_for(std::chrono::seconds(30)) == std::future_status::ready;
  }

  std::vector<StopCapture> captures;
  ScanState state = ScanState::kRunning;
  std::string reason;
  std::function<void()> on_stop;

 private:
  std::promise<void> ended_;
};

StopPlan ThreeStops() {
  StopPlan plan;
  for (const double deg : {-20.0, 0.0, 35.0}) plan.angles_rad.push_back(RadiansFromDegrees(deg));
  plan.lines = 5;
  return plan;
}

struct CaptureStopsTest : testing::Test {
  std::shared_ptr<StopWatch> watch = std::make_shared<StopWatch>();

  /// False when it was refused or never ended.
  bool Run(TinyHead& tiny, const StopPlan& plan) const {
    return tiny.Home() && tiny.head->StartStops(plan, watch) && watch->WaitForEnd();
  }
};

TEST_F(CaptureStopsTest, EachStopHasItsImageAndLinesThatWereMeasuredAtRest) {
  TinyHead tiny;
  ASSERT_TRUE(Run(tiny, ThreeStops()));
  EXPECT_EQ(watch->state, ScanState::kComplete);
  EXPECT_EQ(watch->reason, "");
  ASSERT_EQ(watch->captures.size(), 3u);
  double before_s = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const StopCapture& capture = watch->captures[i];
    EXPECT_EQ(capture.target_rad, ThreeStops().angles_rad[i]);
    // The encoder's steps of 0.02 deg, and where the zero was found.
    EXPECT_NEAR(DegreesFromRadians(capture.position.angle_rad),
                DegreesFromRadians(capture.target_rad), 0.05);
    ASSERT_EQ(capture.lines.size(), 5u);
    for (const LidarLine& line : capture.lines) {
      EXPECT_GT(line.time_s, before_s);
      before_s = line.time_s;
      EXPECT_NEAR(tiny.shaft->At(line.time_s).angle_rad, tiny.shaft->At(before_s).angle_rad, 1e-9);
      EXPECT_EQ(tiny.shaft->At(line.time_s).speed_rad_s, 0.0);
    }
    ASSERT_TRUE(capture.image);
    EXPECT_EQ(capture.image->motor_angle_rad, capture.position.angle_rad);
    EXPECT_EQ(capture.image->target_angle_rad, capture.target_rad);
    EXPECT_EQ(tiny.shaft->At(capture.image->time_s).speed_rad_s, 0.0);
  }
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_TRUE(tiny.AtRest());
  EXPECT_TRUE(tiny.Run(TinyPlan())) << "the head scans afterwards";
}

TEST_F(CaptureStopsTest, WithoutAnImageOrWithoutLinesOnlyTheOtherIsCaptured) {
  TinyHead tiny;
  StopPlan plan = ThreeStops();
  plan.image = false;
  ASSERT_TRUE(Run(tiny, plan));
  EXPECT_FALSE(watch->captures.at(0).image);
  EXPECT_EQ(watch->captures.at(0).lines.size(), 5u);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  watch = std::make_shared<StopWatch>();
  plan.image = true;
  plan.lines = 0;
  ASSERT_TRUE(tiny.head->StartStops(plan, watch));
  ASSERT_TRUE(watch->WaitForEnd());
  EXPECT_TRUE(watch->captures.at(0).image);
  EXPECT_TRUE(watch->captures.at(0).lines.empty());
}

TEST_F(CaptureStopsTest, TheOperatorEndsThemAndKeepsWhatWasCaptured) {
  TinyHead tiny;
  watch->on_stop = [&] { tiny.head->EndScan("enough"); };
  ASSERT_TRUE(Run(tiny, ThreeStops()));
  EXPECT_EQ(watch->state, ScanState::kAborted);
  EXPECT_EQ(watch->reason, "enough");
  EXPECT_EQ(watch->captures.size(), 1u);
  EXPECT_TRUE(tiny.WaitFor(HeadState::kReady));
}

TEST_F(CaptureStopsTest, AStopOfTheMotorEndsThem) {
  TinyHead tiny;
  watch->on_stop = [&] { tiny.head->StopMotor(); };
  ASSERT_TRUE(Run(tiny, ThreeStops()));
  EXPECT_EQ(watch->state, ScanState::kAborted);
  EXPECT_THAT(watch->reason, HasSubstr("stopped the motor"));
  EXPECT_TRUE(tiny.AtRest());
}

TEST_F(CaptureStopsTest, AnImageThatDoesNotComeCostsThatImageOnly) {
  TinyHead tiny(
      [](HeadDevices& devices) { devices.camera = std::make_unique<SilentCamera>(devices.clock); });
  ASSERT_TRUE(Run(tiny, ThreeStops()));
  EXPECT_EQ(watch->state, ScanState::kComplete);
  EXPECT_THAT(watch->reason, HasSubstr("no image came at -20.00, 0.00, 35.00 deg"));
  ASSERT_EQ(watch->captures.size(), 3u);
  EXPECT_EQ(watch->captures[2].lines.size(), 5u);
}

TEST_F(CaptureStopsTest, ALidarThatFallsSilentIsAFaultThatKeepsWhatWasCaptured) {
  TinyHead tiny;
  tiny.lidar->tamper = [n = 0](TamperedLidar::Answer answer) mutable -> TamperedLidar::Answer {
    if (++n > 8) return std::optional<LidarLine>();
    return answer;
  };
  ASSERT_TRUE(Run(tiny, ThreeStops()));
  EXPECT_EQ(watch->state, ScanState::kInterrupted);
  EXPECT_THAT(watch->reason, HasSubstr("test lidar: no line for"));
  EXPECT_EQ(watch->captures.size(), 1u);
  EXPECT_TRUE(tiny.WaitFor(HeadState::kFault));
}

TEST_F(CaptureStopsTest, APlateThatIsTurnedWhileItShouldStandIsAFault) {
  TinyHead tiny;
  tiny.lidar->tamper = [&, n = 0](TamperedLidar::Answer answer) mutable -> TamperedLidar::Answer {
    if (++n == 2)
      tiny.shaft->Move(tiny.clock->Now(), RadiansFromDegrees(-15.0), RadiansFromDegrees(60.0), 7.0);
    return answer;
  };
  StopPlan plan = ThreeStops();
  plan.lines = 20;
  ASSERT_TRUE(Run(tiny, plan));
  EXPECT_EQ(watch->state, ScanState::kInterrupted);
  EXPECT_THAT(watch->reason, HasSubstr("while it should stand"));
}

TEST_F(CaptureStopsTest, AreRefusedUnlessTheHeadIsReadyAndThePlanIsPossible) {
  TinyHead tiny;
  EXPECT_EQ(tiny.head->StartStops(ThreeStops(), watch).error().code, ErrorCode::kState);
  ASSERT_TRUE(tiny.Home());
  StopPlan plan = ThreeStops();
  plan.angles_rad.push_back(RadiansFromDegrees(91.0));
  EXPECT_THAT(tiny.head->StartStops(plan, watch).error().message, HasSubstr("91.00 deg"));
  plan = ThreeStops();
  plan.angles_rad = {std::nan("")};
  EXPECT_FALSE(tiny.head->StartStops(plan, watch));
  plan = ThreeStops();
  plan.lines = -1;
  EXPECT_FALSE(tiny.head->StartStops(plan, watch));
  plan.lines = 0;
  plan.image = false;
  EXPECT_FALSE(tiny.head->StartStops(plan, watch));
}

}  // namespace
}  // namespace foresight
