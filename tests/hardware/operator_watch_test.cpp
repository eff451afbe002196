// What a head does when nobody watches it any more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hardware/assembly/head_config.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A sweep of 10 s, 400 lines.
ScanPlan SlowPlan() {
  ScanPlan plan = TinyPlan();
  plan.speed_rad_s = RadiansFromDegrees(1.0);
  return plan;
}

CaptureOptions Timeout(double seconds) {
  CaptureOptions options;
  options.operator_timeout_s = seconds;
  return options;
}

struct WatchedHead : TinyHead {
  explicit WatchedHead(double timeout_s) : TinyHead([](HeadDevices&) {}, Timeout(timeout_s)) {}
};

TEST(OperatorWatch, AnOperatorWhoIsLostStopsTheSweepAndItsLinesAreKept) {
  WatchedHead tiny(5.0);
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.head->OperatorSeen(); };  // at line 10, for the last time
  const auto scan = tiny.Run(SlowPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_EQ(scan->reason,
            "the operator's link was lost for 5.0 s; the motor was stopped; the scan ends there");
  // 5 s at 40 lines/s, and those at both ends.
  EXPECT_NEAR(static_cast<double>(scan->lines.size()), 210.0, 5.0);
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_TRUE(tiny.AtRest());
  EXPECT_EQ(tiny.head->Status().message, scan->reason);
}

TEST(OperatorWatch, NothingStartsByItselfWhenTheOperatorIsBackButScanningIsPossible) {
  WatchedHead tiny(5.0);
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.head->OperatorSeen(); };
  ASSERT_TRUE(tiny.Run(SlowPlan()));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  tiny.clock->Sleep(std::chrono::seconds(60));
  tiny.head->OperatorSeen();
  EXPECT_TRUE(tiny.AtRest());
  EXPECT_EQ(tiny.head->Status().state, HeadState::kReady);
  const auto assembler = std::make_shared<ScanAssembler>();
  ASSERT_TRUE(tiny.head->StartScan(TinyPlan(), assembler));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(assembler->Snapshot()->state, ScanState::kComplete);
}

/// Sees the head at every line.
class AttentiveSink final : public ScanSink {
 public:
  explicit AttentiveSink(CaptureHead& head) : head_(head) {}
  void OnScanStarted(const Scan&) override {}
  void OnLine(const LidarLine&) override { head_.OperatorSeen(); }
  void OnMotorSamples(std::span<const MotorSample>) override {}
  void OnFrame(const CameraFrame&) override {}
  void OnScanEnded(ScanState, const std::string&) override {}

 private:
  CaptureHead& head_;
};

TEST(OperatorWatch, AnOperatorWhoIsSeenAgainAndAgainGetsTheWholeScan) {
  WatchedHead tiny(1.5);
  ASSERT_TRUE(tiny.Home());
  tiny.sinks = std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{
      std::make_shared<AttentiveSink>(*tiny.head), tiny.assembler, tiny.watch});
  const auto scan = tiny.Run(SlowPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
}

TEST(OperatorWatch, WithATimeoutOfZeroNobodyWatches) {
  WatchedHead tiny(0.0);
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { tiny.head->OperatorSeen(); };
  const auto scan = tiny.Run(SlowPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
}

TEST(OperatorWatch, AnOperatorWhoIsLostEndsTheHoming) {
  WatchedHead tiny(0.1);  // the zero is half a second away
  tiny.head->OperatorSeen();
  ASSERT_TRUE(tiny.head->Home());
  ASSERT_TRUE(tiny.WaitFor(HeadState::kDisconnected));
  EXPECT_THAT(
      tiny.head->Status().message,
      HasSubstr("the operator's link was lost for 0.1 s; the motor was stopped; home again"));
  tiny.clock->Sleep(std::chrono::seconds(1));  // longer than any braking
  EXPECT_TRUE(tiny.AtRest());
  EXPECT_NE(tiny.shaft->At(tiny.clock->Now()).angle_rad, 0.0);
}

TEST(OperatorWatch, TheConfigurationSaysHowLongAndNamesAWrongValue) {
  const auto with = [](const std::string& value) {
    return HeadConfigFromYaml(
        "foresight_head: 1\nlidar: {address: a}\nmotor: {address: b}\n"
        "camera: {address: 10.0.0.3}\ncapture:\n  operator_timeout_s: " +
            value + "\n",
        "head.yaml", "");
  };
  EXPECT_EQ(with("2.5")->capture.operator_timeout_s, 2.5);
  EXPECT_EQ(with("0")->capture.operator_timeout_s, 0.0);
  ASSERT_FALSE(with("-1"));
  EXPECT_THAT(with("-1").error().message, HasSubstr("head.yaml:6: 'operator_timeout_s'"));
}

}  // namespace
}  // namespace foresight
