#include "hardware/head/scan_assembler.h"

#include <gtest/gtest.h>

#include <chrono>

namespace foresight {
namespace {

LidarLine NumberedLine(std::int64_t seq) {
  LidarLine line;
  line.seq = seq;
  line.time_s = 0.025 * static_cast<double>(seq);
  line.range_mm.assign(1081, 1000);
  line.intensity.assign(1081, 100);
  return line;
}

void Grow(ScanAssembler& assembler, std::int64_t from, std::int64_t to) {
  for (std::int64_t i = from; i < to; ++i) {
    const MotorSample sample{0.025 * static_cast<double>(i), 0.0};
    assembler.OnMotorSamples({&sample, 1});
    assembler.OnLine(NumberedLine(i));
  }
}

TEST(ScanAssembler, ASnapshotNeverChanges) {
  ScanAssembler assembler;
  assembler.OnScanStarted(Scan());
  Grow(assembler, 0, 10);
  const auto early = assembler.Snapshot();
  Grow(assembler, 10, 100);
  const auto late = assembler.Snapshot();
  ASSERT_EQ(early->lines.size(), 10u);
  EXPECT_EQ(early->track.samples().size(), 10u);
  ASSERT_EQ(late->lines.size(), 100u);
  EXPECT_EQ(&early->lines[5], &late->lines[5]) << "they share what they have in common";
  EXPECT_EQ(early->lines[9], NumberedLine(9));
}

/// The least time of a snapshot that a new line made necessary.
double SnapshotSeconds(ScanAssembler& assembler, std::int64_t& next) {
  double least_s = 1.0;
  for (int i = 0; i < 50; ++i) {
    Grow(assembler, next, next + 1);
    ++next;
    const auto begin = std::chrono::steady_clock::now();
    const auto snapshot = assembler.Snapshot();
    least_s = std::min(
        least_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least_s;
}

TEST(ScanAssembler, ASnapshotOfTenThousandLinesCostsNoMoreThanOneOfAHundred) {
  ScanAssembler assembler;
  assembler.OnScanStarted(Scan());
  std::int64_t next = 0;
  Grow(assembler, 0, 100);
  next = 100;
  const double few_s = SnapshotSeconds(assembler, next);
  Grow(assembler, next, 10'000);
  next = 10'000;
  const double many_s = SnapshotSeconds(assembler, next);
  RecordProperty("snapshot_us_100", std::to_string(1e6 * few_s));
  RecordProperty("snapshot_us_10000", std::to_string(1e6 * many_s));
  // A hundred times as many lines; a copy of them would take milliseconds.
  EXPECT_LT(many_s, 3.0 * few_s + 20e-6);
}

}  // namespace
}  // namespace foresight
