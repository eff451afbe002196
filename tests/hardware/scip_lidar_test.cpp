// The driver against the emulator, over sockets of this machine.
#include "hardware/scip/scip_lidar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/hardware/scip_bench.h"

namespace foresight {
namespace {

double Rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(ScipLidar, IntroducesItsDeviceAfterTheHandshake) {
  ScipBench bench;
  ASSERT_TRUE(bench.lidar->Connect());
  EXPECT_EQ(bench.lidar->Describe(),
            "lidar " + bench.options.address.ToText() + " (UTM-30LX-EW E0000001)");
  EXPECT_TRUE(bench.lidar->Health().connected);
  EXPECT_FALSE(bench.lidar->Health().streaming);
}

TEST(ScipLidar, StreamsFortyLinesASecondWithoutLoss) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  std::int64_t last_seq = bench.NextLine().seq;
  for (int i = 0; i < 60; ++i) {
    const LidarLine line = bench.NextLine();
    EXPECT_EQ(line.seq, last_seq + 1);
    last_seq = line.seq;
  }
  const LidarHealth health = bench.lidar->Health();
  EXPECT_TRUE(health.streaming);
  EXPECT_NEAR(health.line_rate_hz, 40.0, 4.0);
  EXPECT_EQ(health.lost_lines, 0);
  EXPECT_EQ(health.damaged, 0);
}

TEST(ScipLidar, AllStepsOfTheRealFanComeAtItsPace) {
  const auto scene = std::make_shared<Scene>(TinyWorld()->scene());
  ScipBench bench({}, {}, std::make_shared<const World>(scene, DefaultSensorRig(), WorldOptions()));
  ASSERT_TRUE(bench.Begin());
  std::int64_t last_seq = bench.NextLine().seq;
  for (int i = 0; i < 40; ++i) {
    const LidarLine line = bench.NextLine();
    EXPECT_EQ(line.seq, ++last_seq);
    EXPECT_EQ(line.range_mm.size(), 1081u);
    EXPECT_LT(std::abs(bench.StampError_s(line)), bench.MostStampError_s());
  }
  EXPECT_EQ(bench.lidar->Health().damaged, 0);
}

TEST(ScipLidar, LinesEqualThoseOfTheSimulationInThisProcess) {
  ScipBench bench;
  bench.shaft->Move(bench.clock->Now(), 0.5, 0.3, 5.0);
  ASSERT_TRUE(bench.Begin());
  for (int i = 0; i < 20; ++i) {
    const LidarLine line = bench.NextLine();
    const LidarLine truth = bench.Truth(line);
    EXPECT_EQ(line.range_mm, truth.range_mm);
    EXPECT_EQ(line.intensity, truth.intensity);
    EXPECT_NEAR(line.time_s, truth.time_s, 1e-3);
  }
}

TEST(ScipLidar, StampsAreAsNearTheTruthAsTheClockIsReadAndEven) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  std::vector<double> errors;
  std::vector<double> unevenness;
  for (int i = 0; i < 100; ++i) {
    errors.push_back(bench.StampError_s(bench.NextLine()));
    if (i > 0) unevenness.push_back(errors[errors.size() - 1] - errors[errors.size() - 2]);
  }
  for (const double error : errors) EXPECT_LT(std::abs(error), bench.MostStampError_s());
  RecordProperty("rms_us", static_cast<int>(1e6 * Rms(errors)));
  RecordProperty("unevenness_us", static_cast<int>(1e6 * Rms(unevenness)));
  EXPECT_LT(Rms(unevenness), 0.1e-3);
}

/// The mirrors of real devices turn in 25.05 ms, so the stamps' rounding differs from line to line.
std::shared_ptr<const World> RealMirror() {
  SensorRig rig = TinyRig();
  rig.lidar.period_s = 0.02505;
  const auto scene = std::make_shared<Scene>(TinyWorld()->scene());
  return std::make_shared<const World>(scene, rig, WorldOptions());
}

TEST(ScipLidar, TheRoundingOfTheStampsIsAveragedAway) {
  ScipBench bench({}, {}, RealMirror());
  ASSERT_TRUE(bench.Begin());
  std::vector<double> errors;
  for (int i = 0; i < 120; ++i) {
    const double error = bench.StampError_s(bench.NextLine());
    EXPECT_LT(std::abs(error), bench.MostStampError_s());
    if (i >= 40) errors.push_back(error);
  }
  // The mean is half the round trip, which is the machine's affair.
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / 80.0;
  for (double& error : errors) error -= mean;
  RecordProperty("rms_us", static_cast<int>(1e6 * Rms(errors)));
  std::printf("mean %.3f ms, rms about it %.3f ms\n", 1e3 * mean, 1e3 * Rms(errors));
  // Rounding alone would be 0.29 ms.
  EXPECT_LT(Rms(errors), 0.2e-3);
}

TEST(ScipLidar, TheCalibratedOffsetOfTheStampIsAdded) {
  ScipBench bench({}, [](ScipLidarOptions& options) { options.stamp_offset_s = 0.005; });
  ASSERT_TRUE(bench.Begin());
  EXPECT_NEAR(bench.StampError_s(bench.NextLine()), 0.005, bench.MostStampError_s());
}

TEST(ScipLidar, DataCanBeRangesOnly) {
  ScipBench bench({},
                  [](ScipLidarOptions& options) { options.data = ScipLidarOptions::Data::kRange; });
  ASSERT_TRUE(bench.Begin());
  const LidarLine line = bench.NextLine();
  EXPECT_EQ(line.range_mm, bench.Truth(line).range_mm);
  EXPECT_TRUE(line.intensity.empty());
}

TEST(ScipLidar, DataCanBeTheStrongestEcho) {
  ScipBench bench(
      {}, [](ScipLidarOptions& options) { options.data = ScipLidarOptions::Data::kStrongestEcho; });
  ASSERT_TRUE(bench.Begin());
  const LidarLine line = bench.NextLine();
  EXPECT_EQ(line.range_mm, bench.Truth(line).range_mm);
  EXPECT_EQ(line.intensity, bench.Truth(line).intensity);
}

TEST(ScipLidar, ALineBeforeStartIsNeverHandedOut) {
  ScipBench bench;
  ASSERT_TRUE(bench.Begin());
  bench.NextLine();
  bench.lidar->Stop();
  EXPECT_EQ(bench.lidar->WaitForLine(std::chrono::milliseconds(0)).error().code, ErrorCode::kState);
  const double before_s = bench.clock->Now();
  ASSERT_TRUE(bench.lidar->Start());
  const LidarLine line = bench.NextLine();
  EXPECT_GT(line.time_s + bench.period_s(), before_s);
  EXPECT_EQ(bench.lidar->Health().lost_lines, 0) << "turns between two streams were not wanted";
}

TEST(ScipLidar, TheStampsWrapInTheMiddleOfAScanWithoutATrace) {
  LidarFaults faults;
  faults.clock_start_ms = 0x1000000 - 1000;
  ScipBench bench(faults);
  ASSERT_TRUE(bench.Begin());
  std::int64_t last_seq = bench.NextLine().seq;
  // The driver's first line lies before the wrap or the test tests nothing.
  ASSERT_LT(bench.clock->Now(), 1.0);
  while (bench.clock->Now() < 1.4) {
    const LidarLine line = bench.NextLine();
    EXPECT_EQ(line.seq, ++last_seq);
    EXPECT_LT(std::abs(bench.StampError_s(line)), bench.MostStampError_s());
  }
}

TEST(ScipLidar, AClockThatRunsFastIsFollowed) {
  LidarFaults faults;
  faults.clock_ppm = 100.0;
  // With a period of whole milliseconds the rounding of the stamps would be an error of up to a
  // millisecond that changes with the clock's drift only: nothing averages it away.
  ScipBench bench(faults, {}, RealMirror());
  ASSERT_TRUE(bench.Begin());
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(std::abs(bench.StampError_s(bench.NextLine())), bench.MostStampError_s())
        << "line " << i;
}

}  // namespace
}  // namespace foresight
