// The emulated drive without its wire, in simulated time.
#include <gtest/gtest.h>

#include <cmath>

#include "hardware/emulator/emulated_drive.h"
#include "hardware/emulator/motor_faults.h"
#include "tests/hardware/tiny_head.h"

namespace foresight {
namespace {

using cia402::DriveState;
using cia402::Mode;
using cia402::RxImage;

std::shared_ptr<const World> WorldOfSeed(std::uint64_t seed) {
  WorldOptions options;
  options.seed = seed;
  auto scene = std::make_shared<Scene>();
  scene->lights = {Light()};
  return std::make_shared<const World>(scene, TinyRig(), options);
}

/// A drive and a host that writes and lets time pass.
struct Bench {
  explicit Bench(const EmulatedDriveOptions& options = {}, std::uint64_t seed = 1)
      : drive(WorldOfSeed(seed), shaft, options, 0.0) {}

  /// One cycle at a time, feeding the watchdog.
  void Pass(double seconds) {
    for (const double end_s = time_s + seconds; time_s < end_s;) {
      time_s += EmulatedDrive::kCycle_s;
      drive.Run(time_s);
      drive.Write(time_s, rx);
    }
  }
  void Say(unsigned control) {
    rx.control = static_cast<std::uint16_t>(control);
    drive.Write(time_s, rx);
    Pass(0.004);
  }
  void Enable(Mode mode) {
    rx.mode = mode;
    for (const unsigned word : {0x06U, 0x07U, 0x0FU}) Say(word);
  }
  std::uint16_t Status() { return drive.Read(time_s).status; }

  void BeginHoming() {
    rx.homing_method = 20;
    rx.homing_search_speed = 1000;
    rx.homing_edge_speed = 50;
    rx.homing_acceleration = 20000;
    Enable(Mode::kHoming);
    Say(0x1F);
  }
  /// 13, 12 and 10, as the standard prints them.
  int HomingBits() {
    const std::uint16_t status = Status();
    return (status >> 13 & 1) * 100 + (status >> 12 & 1) * 10 + (status >> 10 & 1);
  }
  void BeginMove(std::int32_t target) {
    rx.target = target;
    rx.speed = 1000;
    rx.acceleration = rx.deceleration = 20000;
    Enable(Mode::kProfilePosition);
    Say(0x1F);
    Say(0x0F);
  }

  std::shared_ptr<SimulatedShaft> shaft =
      std::make_shared<SimulatedShaft>(SimulatedMotor::kPowerOnAngle_rad);
  EmulatedDrive drive;
  RxImage rx;
  double time_s = 0.0;
};

TEST(EmulatedDrive, ShowsTheStatuswordsOfARealTrial) {
  Bench bench;
  bench.Pass(0.01);
  EXPECT_EQ(bench.Status(), 0x0650);
  bench.Say(0x06);
  EXPECT_EQ(bench.Status(), 0x0631);
  bench.Say(0x07);
  EXPECT_EQ(bench.Status(), 0x0633);
  bench.Say(0x0F);
  EXPECT_EQ(bench.Status(), 0x0637);
}

TEST(EmulatedDrive, EnablesOnlyStepByStep) {
  Bench bench;
  bench.Say(0x0F);
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kSwitchOnDisabled);
}

TEST(EmulatedDrive, QuickStopHoldsUntilItIsEnabledAgain) {
  Bench bench;
  bench.BeginMove(4000);
  bench.Pass(0.3);
  bench.Say(0x0B);
  EXPECT_EQ(bench.Status(), 0x0217);  // still braking
  bench.Pass(0.1);
  EXPECT_FALSE(bench.shaft->MovingAt(bench.time_s));
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kQuickStopActive);
  bench.Say(0x0F);
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kOperationEnabled);
  EXPECT_FALSE(bench.shaft->MovingAt(bench.time_s)) << "the old target is forgotten";
}

TEST(EmulatedDrive, BitTenIsThatOfTheLastMoveWhenANewOneBegins) {
  Bench bench;
  bench.BeginMove(0);
  bench.Pass(1.0);
  bench.rx.target = 500;
  bench.rx.control = 0x1F;
  bench.drive.Write(bench.time_s, bench.rx);
  bench.Pass(EmulatedDrive::kCycle_s);
  EXPECT_TRUE(bench.shaft->MovingAt(bench.time_s));
  EXPECT_TRUE(bench.Status() & cia402::status::kTargetReached) << "the trap of real drives";
  bench.Pass(2 * EmulatedDrive::kCycle_s);
  EXPECT_FALSE(bench.Status() & cia402::status::kTargetReached);
}

TEST(EmulatedDrive, ArrivesAtTheMiddleOfNothingButItsTarget) {
  Bench bench;
  bench.BeginMove(-1500);
  bench.Pass(3.0);
  EXPECT_TRUE(bench.Status() & cia402::status::kTargetReached);
  const double way_rad =
      bench.shaft->At(bench.time_s).angle_rad - SimulatedMotor::kPowerOnAngle_rad;
  EXPECT_NEAR(DegreesFromRadians(way_rad), -30.0, 1e-9);
}

TEST(EmulatedDrive, BuffersOneTargetWhileItMoves) {
  Bench bench;
  bench.BeginMove(1000);
  bench.rx.target = 0;
  bench.Say(0x1F);
  bench.Say(0x0F);
  bench.Pass(0.5);
  EXPECT_GT(bench.drive.Read(bench.time_s).velocity, 0) << "the first target comes first";
  bench.Pass(3.0);
  EXPECT_NEAR(bench.drive.Read(bench.time_s).position, 0, 1);
}

TEST(EmulatedDrive, GoesToANewTargetAtOnceWithBitFive) {
  Bench bench;
  bench.BeginMove(1000);
  bench.Pass(0.3);
  bench.rx.target = -1000;
  bench.Say(0x3F);
  bench.Pass(0.2);
  EXPECT_LT(bench.drive.Read(bench.time_s).velocity, 0);
}

// Mean 0 and sigma 0.003 deg of the switch; the drive's cycle adds up to 0.001 deg at 1 deg/s.
TEST(EmulatedDrive, FindsTheZeroAsWellAsTheSwitchRepeats) {
  constexpr int kHomings = 100;
  double sum = 0.0, sum_squares = 0.0;
  for (int seed = 1; seed <= kHomings; ++seed) {
    Bench bench({}, static_cast<std::uint64_t>(seed));
    bench.BeginHoming();
    bench.Pass(5.0);
    ASSERT_EQ(bench.HomingBits(), 11) << "seed " << seed;
    const double zero_deg = DegreesFromRadians(bench.drive.zero_rad());
    sum += zero_deg;
    sum_squares += zero_deg * zero_deg;
  }
  EXPECT_NEAR(sum / kHomings, 0.0005, 0.001);
  EXPECT_NEAR(std::sqrt(sum_squares / kHomings), 0.003, 0.001);
}

TEST(EmulatedDrive, TakesTheSameEdgeFromBothSides) {
  for (const double from_deg : {-20.0, -0.01, 0.01, 20.0}) {
    Bench bench;
    bench.shaft = std::make_shared<SimulatedShaft>(RadiansFromDegrees(from_deg));
    bench.drive = EmulatedDrive(WorldOfSeed(1), bench.shaft, {}, 0.0);
    bench.BeginHoming();
    bench.Pass(6.0);
    ASSERT_EQ(bench.HomingBits(), 11) << "from " << from_deg;
    // Five sigma of the switch.
    EXPECT_NEAR(DegreesFromRadians(bench.drive.zero_rad()), 0.0, 0.016) << "from " << from_deg;
  }
}

TEST(EmulatedDrive, SaysHomedFromTheLastTimeUntilANewSearchHasBegun) {
  Bench bench;
  bench.BeginHoming();
  bench.Pass(5.0);
  bench.Say(0x0F);
  ASSERT_EQ(bench.HomingBits(), 11);
  bench.rx.control = 0x1F;
  bench.drive.Write(bench.time_s, bench.rx);
  bench.Pass(EmulatedDrive::kCycle_s);
  EXPECT_EQ(bench.HomingBits(), 11) << "the trap of real drives";
  bench.Pass(2 * EmulatedDrive::kCycle_s);
  EXPECT_EQ(bench.HomingBits(), 0);
}

TEST(EmulatedDrive, ReportsAHomingErrorWhenTheSwitchNeverShows) {
  Bench bench;
  bench.drive.home_switch().Break();
  bench.BeginHoming();
  bench.Pass(10.0);
  EXPECT_EQ(bench.HomingBits(), 101);
  EXPECT_FALSE(bench.shaft->MovingAt(bench.time_s));
}

TEST(EmulatedDrive, ABlockedShaftIsAFollowingError) {
  Bench bench;
  bench.BeginMove(1000);
  bench.Pass(0.3);
  bench.drive.axis().Block(bench.time_s);
  bench.Pass(0.3);
  EXPECT_EQ(bench.Status(), 0x0618);
  EXPECT_EQ(bench.drive.Read(bench.time_s).error_code, 0x8611);
}

TEST(EmulatedDrive, SoIsAMechanicalStop) {
  Bench bench;
  bench.BeginMove(7000);
  bench.Pass(10.0);
  EXPECT_EQ(bench.drive.Read(bench.time_s).error_code, 0x8611);
  EXPECT_NEAR(DegreesFromRadians(bench.shaft->At(bench.time_s).angle_rad), 120.0, 0.1);
}

TEST(EmulatedDrive, AFaultNeedsARisingResetAndTheWholeWayBack) {
  Bench bench;
  bench.BeginMove(1000);
  bench.drive.axis().Block(bench.time_s);
  bench.Pass(0.3);
  bench.drive.axis().Release(bench.time_s);
  bench.Say(0x0F);
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kFault);
  bench.Say(0x80);
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kSwitchOnDisabled);
  bench.Enable(Mode::kProfilePosition);
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kOperationEnabled);
}

TEST(EmulatedDrive, StopsByItselfWhenItsHostFallsSilent) {
  Bench bench;
  bench.BeginMove(4000);
  bench.Pass(0.1);
  bench.drive.Run(bench.time_s + 0.45);
  EXPECT_TRUE(bench.shaft->MovingAt(bench.time_s + 0.45));
  bench.drive.Run(bench.time_s + 0.6);
  EXPECT_FALSE(bench.shaft->MovingAt(bench.time_s + 0.6));
  bench.time_s += 0.6;
  bench.Pass(0.01);
  EXPECT_EQ(cia402::StateOf(bench.Status()), DriveState::kQuickStopActive)
      << "the old controlword does not enable it again";
}

TEST(MotorFaults, TheSameSeedGivesTheSameFaults) {
  EXPECT_EQ(RandomMotorFaults(3, 2.0, 60.0), RandomMotorFaults(3, 2.0, 60.0));
  EXPECT_NE(RandomMotorFaults(3, 2.0, 60.0), RandomMotorFaults(4, 2.0, 60.0));
}

TEST(MotorFaults, ComeOneAfterTheOtherAtTheRateAskedFor) {
  const auto faults = RandomMotorFaults(1, 2.0, 1000.0);
  for (std::size_t i = 1; i < faults.size(); ++i)
    EXPECT_GE(faults[i].after_s, faults[i - 1].after_s + faults[i - 1].duration_s);
  // 1000 s of 2 s between faults and 0.6 s of each: 385, with a spread of 2/2.6 sqrt(385) = 15.
  EXPECT_NEAR(static_cast<double>(faults.size()), 385.0, 60.0);
}

}  // namespace
}  // namespace foresight
