#include "hardware/link/chunks/scan_items.h"

#include <gtest/gtest.h>

#include "core/mission/mission_file.h"
#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/link/chunks/random_scans.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using samples::AllChunks;
using samples::RandomScan;
using samples::WithHealth;

/// The scan as it was when it had so many lines and samples, and ran.
Scan Earlier(const Scan& scan, std::size_t lines, std::size_t samples, std::size_t frames) {
  Scan part = scan;
  part.lines.Truncate(lines);
  part.frames.Truncate(frames);
  part.track = {};
  for (const MotorSample& sample : scan.track.samples().first(samples)) part.track.Add(sample);
  part.state = ScanState::kRunning;
  part.reason.clear();
  return part;
}

TEST(ScanItems, WhatWasOfferedWhileTheScanRanIsTheSameAtItsEnd) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scan scan = RandomScan(seed, 150, 3);
    Random random(seed, 1);
    const ScanToSend ended = WithHealth(scan);
    const ScanToSend running{Earlier(scan, static_cast<std::size_t>(random.Index(151)),
                                     static_cast<std::size_t>(random.Index(
                                         static_cast<int>(scan.track.samples().size()) + 1)),
                                     static_cast<std::size_t>(random.Index(4))),
                             ""};
    const ItemCounts then = ItemsOf(running), now = ItemsOf(ended);
    for (int number = 1; number <= kChunkKinds; ++number) {
      const auto kind = static_cast<ChunkKind>(number);
      ASSERT_LE(then[kind], now[kind]) << ToString(kind);
      for (std::int64_t item = 0; item < then[kind]; ++item)
        ASSERT_EQ(EncodeItem(running, {kind, item}).value(),
                  EncodeItem(ended, {kind, item}).value())
            << ToString(kind) << " " << item << " of seed " << seed;
    }
  }
}

TEST(ScanItems, BlocksAreOfferedWhenTheyAreFull) {
  const Scan scan = RandomScan(3, 100, 0);
  const ScanToSend running{Earlier(scan, 15, 0, 0), ""};
  EXPECT_EQ(ItemsOf(running)[ChunkKind::kRanges], 1);
  EXPECT_EQ(ItemsOf(running)[ChunkKind::kEnd], 0);
  EXPECT_EQ(ItemsOf({scan, ""})[ChunkKind::kRanges], 13);
  EXPECT_EQ(ItemsOf({scan, ""})[ChunkKind::kEnd], 1);
  EXPECT_EQ(EncodeItem(running, {ChunkKind::kRanges, 1}).error().code, ErrorCode::kState);
  EXPECT_EQ(EncodeItem(running, {ChunkKind::kRanges, -1}).error().code, ErrorCode::kState);
}

TEST(ScanItems, ACoarseCloudWaitsForTheTrack) {
  Scan scan = RandomScan(3, 0, 0);
  scan.track = {};
  scan.state = ScanState::kRunning;
  scan.rig.lidar.beams = 1081;
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    LidarLine line = samples::RandomLine(random, 1081, true);
    line.seq = i;
    line.time_s = 0.025 * i;
    scan.lines.push_back(line);
  }
  for (int i = 0; i < 190; ++i) scan.track.Add({i / 240.0, 0.001 * i});  // until 0.79 s
  EXPECT_EQ(ItemsOf({scan, ""})[ChunkKind::kCoarseCloud], 0);
  // Line 32 ends at 0.819 s, and a straight line is fitted to 20 ms around each time.
  for (int i = 190; i < 202; ++i) scan.track.Add({i / 240.0, 0.001 * i});
  EXPECT_EQ(ItemsOf({scan, ""})[ChunkKind::kCoarseCloud], 0);
  for (int i = 202; i < 203; ++i) scan.track.Add({i / 240.0, 0.001 * i});
  EXPECT_EQ(ItemsOf({scan, ""})[ChunkKind::kCoarseCloud], 1);
}

TEST(ScanItems, LongItemsTravelInPartsOf60kB) {
  const std::string bytes(2 * kMaxPartBytes + 1, 'x');
  const auto parts = SplitItem({ChunkKind::kImage, 3}, bytes).value();
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[2].bytes.size(), 1U);
  for (const Chunk& part : parts) EXPECT_TRUE(CheckChunk(part)) << Describe(part);
}

TEST(ScanItems, ABitThatFlipsAnywhereInAChunkIsNoticed) {
  const Chunk good = SplitItem({ChunkKind::kImage, 3}, "some bytes").value().front();
  const auto refused = [](const Chunk& chunk) { return !CheckChunk(chunk); };
  Chunk bad = good;
  bad.id.kind = ChunkKind::kRanges;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.id.item ^= 1;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.parts = 2;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.item_crc ^= 4;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.bytes[3] ^= 8;
  EXPECT_TRUE(refused(bad));
}

TEST(ScanDigest, IsThatOfTheScanReadBackFromAMission) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Scan scan = RandomScan(seed, 30, 2);
    // A mission keeps intensities of as many beams as there are ranges.
    auto mission = MissionFile::Create(folder / (std::to_string(seed) + ".foresight")).value();
    const std::int64_t id = mission->BeginScan(scan).value();
    for (const LidarLine& line : scan.lines) ASSERT_TRUE(mission->AppendLine(id, line));
    ASSERT_TRUE(mission->AppendMotorSamples(id, scan.track.samples()));
    for (const CameraFrame& frame : scan.frames) ASSERT_TRUE(mission->AppendFrame(id, frame));
    ASSERT_TRUE(mission->EndScan(id, scan.state, scan.reason));
    const Scan back = mission->LoadScan(id).value();
    EXPECT_EQ(ScanDigest(back), ScanDigest(scan));
    const auto chunks = AllChunks(WithHealth(scan)), again = AllChunks(WithHealth(back));
    EXPECT_TRUE(chunks == again) << "a head that was restarted makes other bytes";
  }
}

TEST(ScanDigest, DiffersWithEverythingInAScan) {
  const Scan scan = RandomScan(4, 20, 1);
  const std::string digest = ScanDigest(scan);
  const auto differs = [&](const auto& change) {
    Scan other = scan;
    change(other);
    return ScanDigest(other) != digest;
  };
  EXPECT_TRUE(differs([](Scan& s) { s.uuid += "0"; }));
  EXPECT_TRUE(differs([](Scan& s) { s.start_utc_ns += 1; }));
  EXPECT_TRUE(differs([](Scan& s) { s.source += "!"; }));
  EXPECT_TRUE(differs([](Scan& s) { s.simulated = !s.simulated; }));
  EXPECT_TRUE(differs([](Scan& s) { s.plan.exposure_s *= 1.0 + 1e-15; }));
  EXPECT_TRUE(differs([](Scan& s) { s.rig.name += "!"; }));
  EXPECT_TRUE(differs([](Scan& s) { s.rig.lidar.range_offset_m = 1e-9; }));
  EXPECT_TRUE(differs([](Scan& s) { s.lines.Edit(7).seq += 1; }));
  EXPECT_TRUE(differs([](Scan& s) { s.lines.Edit(7).time_s += 1e-15; }));
  EXPECT_TRUE(differs([](Scan& s) { s.lines.Edit(7).range_mm.push_back(0); }));
  EXPECT_TRUE(differs([](Scan& s) { s.lines.Edit(7).intensity.push_back(0); }));
  EXPECT_TRUE(differs([](Scan& s) { s.lines.Truncate(19); }));
  EXPECT_TRUE(differs([](Scan& s) { s.track.Add({1e9, 0.0}); }));
  EXPECT_TRUE(differs([](Scan& s) { s.frames.Edit(0).image(0, 0).b ^= 1; }));
  EXPECT_TRUE(differs([](Scan& s) { s.frames.Edit(0).target_angle_rad += 1e-15; }));
  EXPECT_TRUE(differs([](Scan& s) { s.frames.clear(); }));
  EXPECT_TRUE(differs([](Scan& s) { s.state = ScanState::kAborted; }));
  EXPECT_TRUE(differs([](Scan& s) { s.reason += "!"; }));
}

TEST(ScanDigest, DoesNotTellTheTwoZerosApart) {
  Scan scan = RandomScan(4, 1, 0);
  scan.lines.Edit(0).time_s = 0.0;
  Scan other = scan;
  other.lines.Edit(0).time_s = -0.0;
  EXPECT_EQ(ScanDigest(scan), ScanDigest(other));
}

}  // namespace
}  // namespace foresight
