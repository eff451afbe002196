// Scans that devices spoil: they never end as complete, and say what was seen.
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/random.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A motor whose answers a test may change.
class TamperedMotor final : public Motor {
 public:
  explicit TamperedMotor(std::unique_ptr<Motor> motor) : motor_(std::move(motor)) {}

  std::string Describe() const override { return "test motor"; }
  Status Connect() override { return motor_->Connect(); }
  Status StartHoming() override { return motor_->StartHoming(); }
  bool Homed() const override { return motor_->Homed(); }
  Status StartMove(double angle_rad, double speed_rad_s) override {
    return motor_->StartMove(angle_rad, speed_rad_s);
  }
  Result<bool> Moving() override { return motor_->Moving(); }
  Result<MotorSample> Position() override {
    Result<MotorSample> sample = motor_->Position();
    if (sample) sample->angle_rad += offset_rad;
    return sample;
  }
  std::vector<MotorSample> TakeTrack() override {
    std::vector<MotorSample> samples = motor_->TakeTrack();
    for (MotorSample& sample : samples) sample.angle_rad += offset_rad;
    return samples;
  }
  void QuickStop() override { motor_->QuickStop(); }
  MotorHealth Health() const override { return motor_->Health(); }

  std::atomic<double> offset_rad{0.0};

 private:
  std::unique_ptr<Motor> motor_;
};

TamperedMotor* Tamper(HeadDevices& devices) {
  auto tampered = std::make_unique<TamperedMotor>(std::move(devices.motor));
  TamperedMotor* motor = tampered.get();
  devices.motor = std::move(tampered);
  return motor;
}

TEST(BrokenScan, AnEncoderThatIsOffByEightyDegreesIsAFaultOfTheMotor) {
  TamperedMotor* motor = nullptr;
  TinyHead tiny([&](HeadDevices& devices) { motor = Tamper(devices); });
  ASSERT_TRUE(tiny.Home());
  tiny.watch->action = [&] { motor->offset_rad = RadiansFromDegrees(80.0); };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, AllOf(HasSubstr("test motor: its encoder jumped from"),
                                  HasSubstr("at the commanded 10.0 deg/s")));
  EXPECT_GE(scan->lines.size(), 10u);
  EXPECT_LT(scan->lines.size(), 15u);
  for (const MotorSample& sample : scan->track.samples())
    EXPECT_LT(std::abs(sample.angle_rad), RadiansFromDegrees(10.0)) << "a refused sample was kept";
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr("test motor: its encoder jumped"));
  motor->offset_rad = 0.0;
  ASSERT_TRUE(tiny.Home());
}

TEST(BrokenScan, AnEncoderThatJumpsBetweenTheScansIsAFaultToo) {
  TamperedMotor* motor = nullptr;
  const TinyHead tiny([&](HeadDevices& devices) { motor = Tamper(devices); });
  ASSERT_TRUE(tiny.Home());
  // Time passes only where somebody waits for it: until the head has looked at the motor again.
  const auto look = [&] {
    tiny.clock->Sleep(std::chrono::milliseconds(20));
    const double now_s = tiny.clock->Now();
    while (tiny.head->Status().time_s < now_s && tiny.head->Status().state == HeadState::kReady)
      std::this_thread::yield();
  };
  look();
  look();
  motor->offset_rad = RadiansFromDegrees(-80.0);
  look();
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr("its encoder jumped"));
}

/// Lets the lines through that `keep` wants; the lidar's own numbers stay as they are.
void Thin(TinyHead& tiny, const std::function<bool(int)>& keep) {
  tiny.lidar->tamper = [keep, n = 0](TamperedLidar::Answer answer) mutable {
    if (answer && *answer && !keep(n++)) return TamperedLidar::Answer(std::nullopt);
    return answer;
  };
}

TEST(BrokenScan, FarFewerLinesThanPlannedAreNotComplete) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  Thin(tiny, [](int n) { return n % 6 == 0; });
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_EQ(scan->reason,
            fmt::format("{} of 42 planned lines came from the lidar", scan->lines.size()));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady)) << "the operator may try again";
  EXPECT_EQ(tiny.head->Status().message, scan->reason);
}

TEST(BrokenScan, EveryTwentiethLineMayBeMissing) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  Thin(tiny, [](int n) { return n % 20 != 19; });
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
}

TEST(BrokenScan, BothPassesCount) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  ScanPlan plan = TinyPlan();
  plan.passes = 2;
  Thin(tiny, [](int n) { return n < 60 || n % 4 == 0; });  // the first pass is whole
  const auto scan = tiny.Run(plan);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, HasSubstr("of 84 planned lines came from the lidar"));
}

/// A computer that did not read the motor for so long in the middle of the scope.
std::shared_ptr<const Scan> RunWithHole(TinyHead& tiny, double hole_s) {
  const ScanPlan plan = TinyPlan();
  const double middle_rad = 0.5 * (plan.from_rad + plan.to_rad);
  const double half_rad = 0.5 * hole_s * plan.speed_rad_s;
  tiny.motor->keep = [=](const MotorSample& sample) {
    return std::abs(sample.angle_rad - middle_rad) > half_rad;
  };
  return tiny.Run(plan);
}

/// Nobody can say where lines looked that were measured while the motor was not read: they are
/// counted, never left out in silence.
TEST(BrokenScan, LinesWithoutAMotorAngleAreCountedAsLost) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto scan = RunWithHole(tiny, 0.15);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kComplete) << scan->reason;
  const HeadStatus status = tiny.head->Status();
  EXPECT_GE(status.lost_lines, 1);
  EXPECT_NEAR(status.lines + status.lost_lines, status.expected_lines, 2);
}

TEST(BrokenScan, ManyLinesWithoutAMotorAngleAreNotBlamedOnTheLidar) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto scan = RunWithHole(tiny, 0.4);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, HasSubstr("the angle of the motor was not read for up to 0.4"));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady)) << "the operator may try again";
}

/// Changes the stamps of the lines from the 20th on.
std::shared_ptr<const Scan> RunWithStamps(TinyHead& tiny,
                                          const std::function<double(double)>& stamp) {
  tiny.lidar->tamper = [stamp, n = 0](TamperedLidar::Answer answer) mutable {
    if (answer && *answer && ++n > 20) (*answer)->time_s = stamp((*answer)->time_s);
    return answer;
  };
  return tiny.Run(TinyPlan());
}

struct BadStamps {
  const char* what;
  std::function<double(double)> stamp;
};

class LidarStamps : public testing::TestWithParam<BadStamps> {};

TEST_P(LidarStamps, ThatCannotBeTrueAreTheLidarsFaultAndNotTheMotors) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  const auto scan = RunWithStamps(tiny, GetParam().stamp);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, AllOf(HasSubstr("test lidar: "), HasSubstr("time stamps"),
                                  HasSubstr(GetParam().what), Not(HasSubstr("motor: stopped"))));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  EXPECT_THAT(tiny.head->Status().message, HasSubstr("test lidar: "));
}

INSTANTIATE_TEST_SUITE_P(
    All, LidarStamps,
    testing::Values(BadStamps{"stand still",
                              [first = 0.0](double time_s) mutable {
                                if (first == 0.0) first = time_s;
                                return first;
                              }},
                    BadStamps{"ran backwards by", [](double time_s) { return time_s - 0.4; }},
                    BadStamps{"jumped ahead by 9.9", [](double time_s) { return time_s + 10.0; }}),
    [](const auto& test) {
      std::string name = test.param.what;
      for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      return name;
    });

TEST(BrokenScan, StampsThatAreLateFromTheBeginningAreTheLidarsFaultToo) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.lidar->tamper = [](TamperedLidar::Answer answer) {
    if (answer && *answer) (*answer)->time_s -= 3.0;
    return answer;
  };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_THAT(scan->reason, AllOf(HasSubstr("test lidar: the motor reached the end of the scope"),
                                  HasSubstr("time stamps are 3.0 s late")));
}

TEST(BrokenScan, LinesThatComeLateArriveBeforeTheEndOfAnAbortedScan) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  // Each line stays on the wire until two more have been measured.
  tiny.lidar->tamper = [wire = std::deque<LidarLine>()](
                           TamperedLidar::Answer answer) mutable -> TamperedLidar::Answer {
    if (!answer || !*answer) return answer;
    wire.push_back(std::move(**answer));
    if (wire.size() < 3) return std::nullopt;
    LidarLine line = std::move(wire.front());
    wire.pop_front();
    return line;
  };
  double aborted_s = 0.0;
  tiny.watch->action = [&] {
    aborted_s = tiny.clock->Now();
    tiny.head->AbortScan();
  };
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->state, ScanState::kAborted);
  // A line is measured in 25 ms; the one that was being measured may be missing.
  EXPECT_GT(scan->lines.back().time_s, aborted_s - 0.05);
  for (std::size_t i = 1; i < scan->lines.size(); ++i)
    EXPECT_EQ(scan->lines[i].seq, scan->lines[i - 1].seq + 1);
}

/// A sink that cannot keep more than some lines.
class FullSink final : public ScanSink {
 public:
  void OnScanStarted(const Scan&) override {}
  void OnLine(const LidarLine&) override { ++lines_; }
  void OnMotorSamples(std::span<const MotorSample>) override {}
  void OnFrame(const CameraFrame&) override {}
  void OnScanEnded(ScanState, const std::string&) override {}
  std::optional<std::string> Failure() const override {
    if (lines_ < 12) return std::nullopt;
    return "m.foresight: the disk is full: 12 of 42 lines were kept";
  }

 private:
  std::atomic<int> lines_{0};
};

TEST(BrokenScan, ASweepThatNobodyRecordsEndsAndSaysWhy) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.Home());
  tiny.sinks = std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{
      tiny.assembler, std::make_shared<FullSink>(), tiny.watch});
  const auto scan = tiny.Run(TinyPlan());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->state, ScanState::kInterrupted);
  EXPECT_EQ(scan->reason, "m.foresight: the disk is full: 12 of 42 lines were kept");
  EXPECT_LT(scan->lines.size(), 20u);
  EXPECT_TRUE(tiny.AtRest());
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(tiny.head->Status().message, scan->reason);
}

TEST(BrokenScan, AnAcceptedScanThatMeetsAFailedMotorIsToldItsEnd) {
  // The motor fails between the scans at the moment when a scan is accepted: whoever is first, the
  // sink hears a beginning and an end, or the start is refused.
  for (int i = 0; i < 20; ++i) {
    TinyHead tiny;
    ASSERT_TRUE(tiny.Home());
    tiny.motor->failing = true;
    const Status started = tiny.head->StartScan(TinyPlan(), tiny.sinks);
    if (!started) {
      EXPECT_EQ(started.error().code, ErrorCode::kState);
      continue;
    }
    ASSERT_TRUE(tiny.watch->WaitForEnd());
    EXPECT_EQ(tiny.assembler->Snapshot()->state, ScanState::kInterrupted);
    ASSERT_TRUE(tiny.WaitFor(HeadState::kFault));
  }
}

SensorRig OtherRig() {
  SensorRig rig = TinyRig();
  rig.lidar.range_offset_m += 0.01;
  return rig;
}

TEST(RigInForce, IsThatOfTheNextScan) {
  TinyHead tiny;
  ASSERT_TRUE(tiny.head->SetRig(OtherRig())) << "a head that is not connected may be prepared";
  ASSERT_TRUE(tiny.head->SetRig(TinyRig()));
  ASSERT_TRUE(tiny.Home());
  Status during;
  tiny.watch->action = [&] { during = tiny.head->SetRig(OtherRig()); };
  const auto first = tiny.Run(TinyPlan());
  ASSERT_TRUE(first);
  EXPECT_EQ(first->rig.lidar, TinyRig().lidar);
  ASSERT_FALSE(during);
  EXPECT_EQ(during.error().code, ErrorCode::kState);
  EXPECT_THAT(during.error().message, HasSubstr("cannot take another calibration while sweeping"));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  ASSERT_TRUE(tiny.head->SetRig(OtherRig()));
  EXPECT_EQ(tiny.head->Rig().lidar, OtherRig().lidar);
  const auto assembler = std::make_shared<ScanAssembler>();
  ASSERT_TRUE(tiny.head->StartScan(TinyPlan(), assembler));
  ASSERT_TRUE(tiny.WaitFor(HeadState::kReady));
  EXPECT_EQ(assembler->Snapshot()->rig.lidar, OtherRig().lidar);
}

TEST(RigInForce, AnUnusableOneOrThatOfAnotherHeadIsRefused) {
  const TinyHead tiny;
  SensorRig unusable = TinyRig();
  unusable.camera.fx = -1.0;
  EXPECT_EQ(tiny.head->SetRig(unusable).error().code, unusable.Check().error().code);
  const Status other = tiny.head->SetRig(DefaultSensorRig());
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("1081 beams"));
  EXPECT_EQ(tiny.head->Rig().lidar, TinyRig().lidar);
}

}  // namespace
}  // namespace foresight
