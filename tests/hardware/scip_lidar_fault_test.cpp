// What can go wrong between the driver and its device, and what becomes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/hardware/scip_bench.h"

namespace foresight {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ScipLidarFaults, CorruptScansAreLostAndCountedNothingElseIs) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  std::int64_t last_seq = bench.NextLine().seq;
  bench.emulator->InjectCorruptScans(3);
  ASSERT_TRUE(Eventually([&] { return bench.emulator->counts().corrupted == 3; }));
  std::int64_t missing = 0;
  for (int i = 0; i < 20; ++i) {
    const LidarLine line = bench.NextLine();
    missing += line.seq - last_seq - 1;
    last_seq = line.seq;
    EXPECT_EQ(line.range_mm, bench.Truth(line).range_mm);
  }
  EXPECT_EQ(missing, 3);
  EXPECT_EQ(bench.lidar->Health().damaged, 3);
  EXPECT_EQ(bench.lidar->Health().lost_lines, 3);
  EXPECT_EQ(bench.lidar->Health().stalls, 0);
}

TEST(ScipLidarFaults, FragmentsOfSevenBytesAndFivePercentDamageCostOnlyTheDamaged) {
  LidarFaults faults;
  faults.fragment_bytes = 7;
  faults.corrupt_fraction = 0.05;
  ScipBench bench(faults);
  ASSERT_TRUE(bench.Begin());
  std::int64_t last_seq = bench.NextLine().seq;
  std::int64_t missing = 0;
  for (int i = 0; i < 40; ++i) {
    const LidarLine line = bench.NextLine();
    missing += line.seq - last_seq - 1;
    last_seq = line.seq;
    EXPECT_EQ(line.range_mm, bench.Truth(line).range_mm);
  }
  EXPECT_LE(missing, bench.emulator->counts().corrupted);
  EXPECT_EQ(bench.lidar->Health().reconnects, 0);
}

TEST(ScipLidarFaults, AShortStallIsRecoveredOnTheSameConnection) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  const std::int64_t before = bench.NextLine().seq;
  bench.emulator->InjectStall(0.3);
  ASSERT_TRUE(Eventually([&] { return bench.lidar->Health().stalls > 0; }));
  std::int64_t after = before;
  ASSERT_TRUE(Eventually([&] { return (after = bench.NextLine().seq) > before + 10; }));
  const LidarHealth health = bench.lidar->Health();
  EXPECT_GE(health.lost_lines, 10) << "the gap shows";
  EXPECT_EQ(health.reconnects, 0);
  EXPECT_EQ(bench.emulator->counts().clients, 1);
}

TEST(ScipLidarFaults, ThreeStallsInARowBringANewConnection) {
  ScipBench bench({}, [](ScipLidarOptions& options) { options.stall_s = 0.1; });
  ASSERT_TRUE(bench.Begin());
  const LidarLine before = bench.NextLine();
  bench.emulator->InjectSilence(0.8);
  ASSERT_TRUE(Eventually([&] { return bench.lidar->Health().reconnects > 0; }));
  LidarLine after = before;
  ASSERT_TRUE(Eventually([&] { return (after = bench.NextLine()).time_s > before.time_s + 0.5; }));
  EXPECT_EQ(after.seq - before.seq, bench.TurnOf(after) - bench.TurnOf(before));
}

TEST(ScipLidarFaults, AStreamThatStaysSilentIsRebooted) {
  ScipBench bench({}, [](ScipLidarOptions& options) { options.stall_s = 0.1; });
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  bench.emulator->InjectStall(3600.0);
  ASSERT_TRUE(Eventually([&] { return bench.emulator->counts().reboots == 1; }));
  ASSERT_TRUE(Eventually([&] { return bench.lidar->Health().streaming; }));
  const LidarLine line = bench.NextLine();
  EXPECT_LT(std::abs(bench.StampError_s(line)), bench.MostStampError_s()) << "its clock began anew";
  EXPECT_EQ(bench.lidar->Health().reboots, 1);
}

TEST(ScipLidarFaults, AResetInMidScanShowsAsAGap) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  LidarLine before = bench.NextLine();
  bench.emulator->InjectReset();
  ASSERT_TRUE(Eventually([&] { return bench.emulator->counts().clients == 2; }));
  LidarLine after;
  ASSERT_TRUE(Eventually([&] {
    after = bench.NextLine();
    if (after.seq > before.seq + 1) return true;
    before = after;
    return false;
  }));
  EXPECT_EQ(after.seq - before.seq, bench.TurnOf(after) - bench.TurnOf(before));
  EXPECT_EQ(bench.lidar->Health().lost_lines, after.seq - before.seq - 1);
  EXPECT_EQ(bench.lidar->Health().reconnects, 1);
  EXPECT_LT(std::abs(bench.StampError_s(after)), bench.MostStampError_s());
  RecordProperty("gap_ms", static_cast<int>(1e3 * (after.time_s - before.time_s)));
}

TEST(ScipLidarFaults, ADeviceThatBootsIsWaitedFor) {
  LidarFaults faults;
  faults.boot_delay_s = 0.7;
  ScipBench bench(faults);
  ASSERT_TRUE(bench.Begin());
  EXPECT_GE(bench.clock->Now(), 0.7);
  bench.NextLine();
}

TEST(ScipLidarFaults, ADeviceThatBootsForTooLongIsAnError) {
  LidarFaults faults;
  faults.boot_delay_s = 3600.0;
  ScipBench bench(faults, [](ScipLidarOptions& options) {
    options.boot_timeout_s = 0.1;
    options.connect_timeout_s = 0.1;
  });
  const Status connected = bench.lidar->Connect();
  ASSERT_FALSE(connected);
  EXPECT_EQ(connected.error().code, ErrorCode::kDevice);
  EXPECT_EQ(connected.error().message, "lidar " + bench.options.address.ToText() +
                                           ": refused TM0, status 10: refused in this state");
}

TEST(ScipLidarFaults, AnAbnormalDeviceIsRebootedAndThenWorks) {
  LidarFaults faults;
  faults.abnormal = true;
  ScipBench bench(faults);
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  EXPECT_EQ(bench.emulator->counts().reboots, 1);
}

TEST(ScipLidarFaults, ADeviceThatFallsIntoTheAbnormalStateIsRebooted) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  bench.emulator->InjectAbnormalState();
  ASSERT_TRUE(Eventually([&] { return bench.lidar->Health().reboots == 1; }));
  ASSERT_TRUE(Eventually([&] { return bench.lidar->Health().streaming; }));
}

TEST(ScipLidarFaults, AnIgnoredQuitIsAskedAgain) {
  LidarFaults faults;
  faults.ignores_first_quit = true;
  ScipBench bench(faults, [](ScipLidarOptions& options) { options.reply_timeout_s = 0.2; });
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  EXPECT_EQ(bench.emulator->counts().clients, 1);
}

TEST(ScipLidarFaults, ConnectingToNothingSaysSoInOneLine) {
  TcpListener nobody = TcpListener::Listen({}).value();
  nobody.Refuse();
  ScipLidarOptions options;
  options.address = nobody.address();
  options.connect_timeout_s = 0.05;
  ScipLidar lidar(options, std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime));
  const Status connected = lidar.Connect();
  ASSERT_FALSE(connected);
  EXPECT_EQ(connected.error().code, ErrorCode::kDevice);
  EXPECT_EQ(connected.error().message,
            "lidar " + nobody.address().ToText() + ": cannot connect: Connection refused");
  EXPECT_EQ(lidar.Start().error().code, ErrorCode::kState);
}

TEST(ScipLidarFaults, ASecondClientIsRefusedUntilTheFirstHasGone) {
  ScipBench bench;
  ASSERT_TRUE(bench.lidar->Connect());
  ScipLidarOptions impatient = bench.options;
  impatient.connect_timeout_s = 0.05;
  ScipLidar second(impatient, bench.clock);
  EXPECT_THAT(second.Connect().error().message, EndsWith("Connection refused"));
  ScipLidar patient(bench.options, bench.clock);
  bench.lidar.reset();
  EXPECT_TRUE(patient.Connect());
}

TEST(ScipLidarFaults, AnotherDeviceThanExpectedIsRefusedAtOnce) {
  ScipBench bench({}, [](ScipLidarOptions& options) { options.model = "UST-20LX"; });
  const Status connected = bench.lidar->Connect();
  ASSERT_FALSE(connected);
  EXPECT_EQ(connected.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(connected.error().message, HasSubstr("is a UTM-30LX-EW, expected a UST-20LX"));
}

TEST(ScipLidarFaults, AnotherFanThanExpectedIsRefusedAtOnce) {
  ScipBench bench({}, [](ScipLidarOptions& options) { options.last_step = 1080; });
  EXPECT_THAT(bench.lidar->Connect().error().message,
              EndsWith("measures steps 0 to 60, expected 0 to 1080"));
}

TEST(ScipLidarFaults, ALostDeviceFailsAfterTheTimeOfTheOptions) {
  ScipBench bench({}, [](ScipLidarOptions& options) { options.lost_s = 0.5; });
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  bench.emulator.reset();
  std::string message;
  ASSERT_TRUE(Eventually([&] {
    const auto line = bench.lidar->WaitForLine(std::chrono::milliseconds(50));
    if (!line) message = line.error().message;
    return !line;
  }));
  EXPECT_THAT(message, StartsWith("lidar " + bench.options.address.ToText() + ": no scan for "));
  EXPECT_THAT(message, HasSubstr("Connection refused"));
}

TEST(ScipLidarFaults, DestroyedInMidScanItLeavesADeviceForTheNextClient) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  const auto before = std::chrono::steady_clock::now();
  bench.lidar.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
  ScipLidar next(bench.options, bench.clock);
  EXPECT_TRUE(next.Connect());
}

TEST(ScipLidarFaults, DestroyedBetweenTwoAttemptsItDoesNotWait) {
  ScipBench bench({}, [](ScipLidarOptions& options) {
    options.first_backoff_s = options.last_backoff_s = 3600.0;
  });
  ASSERT_TRUE(bench.Begin());
  bench.emulator.reset();
  ASSERT_TRUE(Eventually([&] { return !bench.lidar->Health().connected; }));
  const auto before = std::chrono::steady_clock::now();
  bench.lidar.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
}

}  // namespace
}  // namespace foresight
