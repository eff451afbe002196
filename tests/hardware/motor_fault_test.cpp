// What the driver does when the drive, the switch or the wire fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hardware/motor_bench.h"

namespace foresight {
namespace {

using testing::HasSubstr;

MotorFault Lasting(MotorFault::Kind kind, double duration_s) {
  return {kind, 0.0, duration_s};
}

std::string ErrorOf(const ModbusMotor& motor, const Result<bool>& moving) {
  EXPECT_FALSE(moving) << motor.Describe() << " reports no error";
  return moving ? "" : moving.error().message;
}

TEST(MotorFault, ABlockedPlateIsNamedWithTheDrivesCode) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kBlockedShaft, 60.0));
  ASSERT_TRUE(bench.WaitForError());
  const std::string expected =
      bench.motor->Describe() +
      ": following error (603F = 8611h); clear the obstacle and home again";
  EXPECT_EQ(ErrorOf(*bench.motor, bench.motor->Moving()), expected);
  EXPECT_EQ(bench.motor->Position().error().message, expected);
  EXPECT_EQ(bench.Go(0.0, 10.0).error().message, expected);
  EXPECT_EQ(bench.motor->Health().last_error, 0x8611);
}

TEST(MotorFault, OnlyTheOperatorsHomingEnablesTheDriveAgain) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kBlockedShaft, 60.0));
  ASSERT_TRUE(bench.WaitForError());
  bench.emulator->ClearFaults();
  EXPECT_FALSE(bench.Go(0.0, 10.0));
  ASSERT_TRUE(bench.motor->Connect());
  EXPECT_FALSE(bench.motor->Moving()) << "connecting is no consent";
  EXPECT_EQ(bench.emulator->State().state(), cia402::DriveState::kFault);
  ASSERT_TRUE(bench.Home());
  ASSERT_TRUE(bench.Go(3.0, 30.0) && bench.WaitForRest());
  EXPECT_NEAR(bench.ShaftDeg(), 3.0, MotorBench::kTolerance_deg);
}

TEST(MotorFault, HomingAgainstAnObstacleThatIsStillThereFails) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kBlockedShaft, 60.0));
  ASSERT_TRUE(bench.WaitForError());
  ASSERT_TRUE(bench.motor->StartHoming());
  ASSERT_TRUE(bench.WaitForError());
  EXPECT_FALSE(bench.motor->Homed());
  EXPECT_FALSE(bench.ShaftTurns());
}

TEST(MotorFault, ALostHomeSwitchEndsTheSearchAtTheMechanicalStop) {
  MotorEmulatorOptions emulated;
  emulated.drive.end_stop_rad = RadiansFromDegrees(15.0);
  const MotorBench bench(emulated);
  bench.emulator->Inject(Lasting(MotorFault::Kind::kLostHomeSwitch, 60.0));
  ASSERT_TRUE(bench.motor->Connect());
  ASSERT_TRUE(bench.motor->StartHoming());
  ASSERT_TRUE(bench.WaitForError());
  EXPECT_THAT(ErrorOf(*bench.motor, bench.motor->Moving()),
              HasSubstr("found no edge of its home switch (homing error, 6041h = "));
  EXPECT_FALSE(bench.motor->Homed());
  ASSERT_TRUE(bench.WaitFor([&] { return !bench.ShaftTurns(); }));
  bench.emulator->ClearFaults();
  EXPECT_TRUE(bench.Home()) << "once it is repaired";
}

TEST(MotorFault, ADeadLinkWhileMovingIsAnErrorAndTheDriveStopsByItself) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  const double began_s = bench.clock->Now();
  bench.emulator->Inject(Lasting(MotorFault::Kind::kDeadLink, 60.0));
  ASSERT_TRUE(bench.WaitForError());
  std::printf("dead link noticed after %.0f ms\n", 1e3 * (bench.clock->Now() - began_s));
  EXPECT_EQ(ErrorOf(*bench.motor, bench.motor->Moving()),
            bench.motor->Describe() + ": no answer within 200 ms");
  EXPECT_FALSE(bench.motor->Homed());
  EXPECT_FALSE(bench.motor->Health().connected);
  ASSERT_TRUE(bench.WaitFor([&] { return !bench.ShaftTurns(); }, 3.0));
  std::printf("at rest after %.0f ms, watchdog 500 ms\n", 1e3 * (bench.clock->Now() - began_s));
}

TEST(MotorFault, CallersNeverWaitForADeadLink) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kDeadLink, 60.0));
  double longest_s = 0.0;
  ASSERT_TRUE(bench.WaitFor([&] {
    const double began_s = bench.clock->Now();
    bench.motor->QuickStop();
    bench.motor->TakeTrack();
    const bool failed = !bench.motor->Position();
    longest_s = std::max(longest_s, bench.clock->Now() - began_s);
    return failed;
  }));
  EXPECT_LT(longest_s, 0.2) << "the response time";
}

TEST(MotorFault, AfterADeadLinkItConnectsByItselfAndHomesAgain) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kDeadLink, 0.6));
  ASSERT_TRUE(bench.WaitForError());
  ASSERT_TRUE(bench.WaitFor([&] { return bench.motor->Health().connected; }));
  EXPECT_FALSE(bench.motor->Position()) << "until the operator has come";
  EXPECT_FALSE(bench.ShaftTurns());
  ASSERT_TRUE(bench.Home());
  EXPECT_EQ(bench.motor->Health().reconnects, 1);
  ASSERT_TRUE(bench.Go(-3.0, 30.0) && bench.WaitForRest());
  EXPECT_NEAR(bench.ShaftDeg(), -3.0, MotorBench::kTolerance_deg);
}

TEST(MotorFault, AResetConnectionStopsTheMotorAsSoonAsItIsBack) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  const double began_s = bench.clock->Now();
  bench.emulator->Inject(Lasting(MotorFault::Kind::kTcpReset, 0.0));
  ASSERT_TRUE(bench.WaitForError());
  EXPECT_THAT(ErrorOf(*bench.motor, bench.motor->Moving()), HasSubstr("connection lost"));
  ASSERT_TRUE(bench.WaitFor([&] { return !bench.ShaftTurns(); }));
  std::printf("at rest %.0f ms after a reset connection\n", 1e3 * (bench.clock->Now() - began_s));
  EXPECT_LT(bench.clock->Now() - began_s, 0.5) << "before the drive's watchdog";
  ASSERT_TRUE(bench.Home());
}

// Bits 10 and 12 that tell of the last move must not end the next one.
/// Somebody else who only looks, as a monitor does: reads all the time.
class Reader {
 public:
  explicit Reader(const TcpAddress& address)
      : thread_([this, address](const std::stop_token& stop) {
          ModbusLink link(address.host, address.port, std::chrono::milliseconds(200));
          if (!link.Connect()) return;
          cia402::TxImage::Registers registers{};
          while (!stop.stop_requested() && link.Read(cia402::TxImage::kFirst, registers)) ++reads_;
        }) {}
  int reads() const { return reads_; }

 private:
  std::atomic<int> reads_{0};
  std::jthread thread_;  ///< last: it uses the above
};

TEST(MotorFault, AReaderDoesNotFeedTheWatchdogOfAHostThatIsGone) {
  MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  const Reader reader(bench.emulator->address());
  ASSERT_TRUE(MotorBench::WaitFor([&] { return reader.reads() > 10; }));
  ASSERT_TRUE(bench.ShaftTurns()) << "a reader does not take over, either";
  // The host vanishes as a killed program does: its connection ends and no quick stop is written.
  // A link of its own writes first, which makes it the one that commands, and goes.
  {
    ModbusLink host(bench.emulator->address().host, bench.emulator->address().port,
                    std::chrono::milliseconds(200));
    ASSERT_TRUE(host.Connect());
    constexpr std::uint16_t kKeepOn = cia402::control::kEnableOperation;
    ASSERT_TRUE(host.Write(cia402::RxImage::kControl, {&kKeepOn, 1}));
    ASSERT_TRUE(bench.ShaftTurns());
  }
  const int reads_before = reader.reads();
  const double gone_s = bench.clock->Now();
  ASSERT_TRUE(MotorBench::WaitFor([&] { return !bench.ShaftTurns(); }));
  // Half a second of the watchdog and a ramp from 20 deg/s; the rest is for a busy machine.
  EXPECT_LT(bench.clock->Now() - gone_s, 1.5);
  EXPECT_GT(reader.reads(), reads_before) << "the reader reads on";
}

TEST(MotorFault, StaleStatusBitsDelayAMoveAndNeverEndIt) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Home());
  ASSERT_TRUE(bench.Go(2.0, 60.0) && bench.WaitForRest());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kStaleStatus, 0.3));
  ASSERT_TRUE(bench.Go(-5.0, 60.0));
  ASSERT_TRUE(bench.WaitForRest());
  ASSERT_TRUE(bench.motor->Moving()) << bench.motor->Moving().error().message;
  EXPECT_NEAR(bench.ShaftDeg(), -5.0, MotorBench::kTolerance_deg);
}

TEST(MotorFault, StaleStatusBitsDoNotEndAHomingThatHasNotBegun) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Home());
  const double first_zero_rad = bench.emulator->zero_rad();
  bench.emulator->Inject(Lasting(MotorFault::Kind::kStaleStatus, 0.05));
  ASSERT_TRUE(bench.Home());
  EXPECT_NE(bench.emulator->zero_rad(), first_zero_rad) << "it did search";
  EXPECT_FALSE(bench.ShaftTurns());
}

TEST(MotorFault, StatusBitsThatNeverComeAreAnError) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Home());
  ASSERT_TRUE(bench.Go(2.0, 60.0) && bench.WaitForRest());
  bench.emulator->Inject(Lasting(MotorFault::Kind::kStaleStatus, 60.0));
  ASSERT_TRUE(bench.Go(-5.0, 60.0));
  ASSERT_TRUE(bench.WaitForError());
  EXPECT_THAT(ErrorOf(*bench.motor, bench.motor->Moving()),
              HasSubstr("did not acknowledge the target within 1000 ms (6041h = "));
  EXPECT_TRUE(bench.WaitFor([&] { return !bench.ShaftTurns(); }));
}

TEST(MotorFault, APlannedFaultComesAtItsTime) {
  MotorEmulatorOptions emulated;
  emulated.faults = {{MotorFault::Kind::kTcpReset, 0.3, 0.0}};
  const MotorBench bench(emulated);
  ASSERT_TRUE(bench.motor->Connect());
  EXPECT_TRUE(bench.motor->Position());
  EXPECT_TRUE(bench.WaitForError());
}

/// Whatever the seed sends, in the middle of a move: the motor comes to rest, and the operator gets
/// it to work again.
class MotorFaults : public testing::TestWithParam<int> {};

TEST_P(MotorFaults, LeaveAMotorAtRestThatCanBeHomedAgain) {
  const MotorBench bench;
  ASSERT_TRUE(bench.Sweep());
  const auto faults = RandomMotorFaults(static_cast<std::uint64_t>(GetParam()), 0.3, 1.5);
  ASSERT_FALSE(faults.empty());
  for (const MotorFault& fault : faults) bench.emulator->Inject(fault);
  bench.WaitFor([&] { return !bench.motor->Moving(); }, 1.0);
  bench.motor->QuickStop();
  EXPECT_TRUE(bench.WaitFor([&] { return !bench.ShaftTurns(); }, 3.0));
  bench.emulator->ClearFaults();
  EXPECT_TRUE(bench.WaitFor([&] { return bench.Home(); }, 8.0));
}

INSTANTIATE_TEST_SUITE_P(Seeds, MotorFaults, testing::Range(1, 4));

}  // namespace
}  // namespace foresight
