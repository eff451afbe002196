#include "hardware/link/chunks/scan_builder.h"

#include <gtest/gtest.h>

#include <set>

#include "hardware/link/chunks/item_bytes.h"
#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

using samples::AllChunks;
using samples::ExpectSame;
using samples::KeepingSink;
using samples::RandomScan;
using samples::Shuffle;
using samples::WithHealth;

Chunk ChunkWith(const ItemId& id, const std::string& bytes) {
  return SplitItem(id, bytes).value().front();
}

/// Bytes differ somewhere, in what the CRC covers or in the CRC itself.
Chunk Damaged(Chunk chunk, Random& random) {
  if (chunk.bytes.empty() || random.Index(5) == 0) {
    chunk.crc ^= 1U << random.Index(32);
  } else if (random.Index(2) == 0) {
    chunk.bytes.resize(
        static_cast<std::size_t>(random.Index(static_cast<int>(chunk.bytes.size()))));
  } else {
    const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(chunk.bytes.size())));
    chunk.bytes[at] = static_cast<char>(chunk.bytes[at] ^ 1 << random.Index(8));
  }
  return chunk;
}

TEST(ScanBuilder, EveryCompleteSetGivesTheSameScan) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed, 2);
    const int lines = seed < 3 ? static_cast<int>(seed) : random.Index(120);
    const Scan scan = RandomScan(seed, lines, random.Index(3));
    std::vector<Chunk> chunks = AllChunks(WithHealth(scan));
    const std::size_t all = chunks.size();
    for (std::size_t i = 0; i < all / 3; ++i)
      chunks.push_back(chunks[static_cast<std::size_t>(random.Index(static_cast<int>(all)))]);
    Shuffle(chunks, random);
    ScanBuilder builder(scan.uuid);
    KeepingSink sink;
    std::size_t taken = 0;
    bool health_came_first = false;
    for (const Chunk& chunk : chunks) {
      EXPECT_EQ(builder.Take(Damaged(chunk, random)).error().code, ErrorCode::kBadData);
      const auto result = builder.Take(chunk);
      ASSERT_TRUE(result) << result.error().message;
      taken += *result == ScanBuilder::Taken::kNew ? 1U : 0U;
      if (random.Index(3) == 0) builder.DeliverTo(sink);
      if (sink.ended == 0) health_came_first = !builder.health_json().empty();
    }
    EXPECT_EQ(taken, all);
    builder.DeliverTo(sink);
    const auto whole = builder.Whole();
    ASSERT_TRUE(whole) << whole.error().message;
    ExpectSame(*whole, scan);
    EXPECT_EQ(ScanDigest(*whole), ScanDigest(scan));
    ExpectSame(sink.scan, scan);
    EXPECT_EQ(sink.ended, 1);
    const HealthReport health = health_came_first ? samples::SomeHealth() : HealthReport{};
    EXPECT_TRUE(ToJson(sink.health) == ToJson(health)) << seed;
    EXPECT_TRUE(builder.Progress().complete);
  }
}

TEST(ScanBuilder, ASourceAndABuilderThatMeetAgainAndAgainMoveTheWholeScan) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed, 3);
    const Scan scan = RandomScan(seed, 100, 2);
    ScanBuilder builder(scan.uuid);
    for (int stream = 0; stream < 100 && !builder.Whole(); ++stream) {
      ChunkSource source(WithHealth(scan), ChunkSet::Decode(builder.Have().Encode()).value());
      // What the station did not get before the path broke comes again.
      for (int i = 0; i < 40; ++i) {
        const auto chunk = source.Next().value();
        if (!chunk) break;
        if (random.Index(10) == 0) break;
        ASSERT_EQ(builder.Take(*chunk).value(), ScanBuilder::Taken::kNew) << Describe(*chunk);
      }
    }
    ASSERT_TRUE(builder.Whole());
    ExpectSame(*builder.Whole(), scan);
  }
}

TEST(ScanBuilder, SaysWhatIsMissing) {
  const Scan scan = RandomScan(5, 50, 2);
  const auto chunks = AllChunks(WithHealth(scan));
  for (const Chunk& left_out : chunks) {
    ScanBuilder builder(scan.uuid);
    KeepingSink sink;
    for (const Chunk& chunk : chunks)
      if (chunk.id != left_out.id) {
        ASSERT_TRUE(builder.Take(chunk));
      }
    builder.DeliverTo(sink);
    const auto whole = builder.Whole();
    using enum ChunkKind;
    const bool needed = std::set{kHeader, kRig, kTrack, kRanges, kIntensities, kImage, kEnd}.count(
                            left_out.id.kind) == 1;
    EXPECT_EQ(!whole.has_value(), needed) << Describe(left_out);
    EXPECT_EQ(sink.ended, needed ? 0 : 1) << Describe(left_out);
    EXPECT_TRUE(!needed || whole.error().code == ErrorCode::kState) << Describe(left_out);
  }
}

TEST(ScanBuilder, DeliversLinesInOrderAsSoonAsNothingBeforeThemIsMissing) {
  const Scan scan = RandomScan(6, 40, 0);
  ScanBuilder builder(scan.uuid);
  KeepingSink sink;
  std::map<ItemId, Chunk> chunks;
  for (const Chunk& chunk : AllChunks(WithHealth(scan))) chunks[chunk.id.Item()] = chunk;
  const auto take = [&](ChunkKind kind, std::int64_t item) {
    ASSERT_TRUE(builder.Take(chunks.at({kind, item})));
    builder.DeliverTo(sink);
  };
  take(ChunkKind::kRanges, 0);
  take(ChunkKind::kIntensities, 0);
  take(ChunkKind::kHeader, 0);
  EXPECT_EQ(sink.started, 0);
  take(ChunkKind::kRig, 0);
  EXPECT_EQ(sink.started, 1);
  EXPECT_EQ(sink.scan.lines.size(), 8U);
  take(ChunkKind::kIntensities, 2);
  take(ChunkKind::kRanges, 2);
  take(ChunkKind::kRanges, 1);
  EXPECT_EQ(sink.scan.lines.size(), 8U);
  take(ChunkKind::kIntensities, 1);
  EXPECT_EQ(sink.scan.lines.size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(sink.scan.lines[i], scan.lines[i]);
}

TEST(ScanBuilder, GoesOnWhereTheMissionEndedAfterARestart) {
  const Scan scan = RandomScan(7, 60, 2);
  const auto chunks = AllChunks(WithHealth(scan));
  KeepingSink sink;
  ScanBuilder before(scan.uuid);
  for (std::size_t i = 0; i < chunks.size() / 2; ++i) ASSERT_TRUE(before.Take(chunks[i]));
  before.DeliverTo(sink);
  ScanBuilder after(scan.uuid);  // reads its spool again
  after.SetDelivered({true, sink.scan.lines.size(), sink.scan.track.samples().size(),
                      sink.scan.frames.size(), false});
  for (const Chunk& chunk : chunks) ASSERT_TRUE(after.Take(chunk));
  after.DeliverTo(sink);
  ExpectSame(sink.scan, scan);
}

TEST(ScanBuilder, APartialScanHasWhatIsThereInOrder) {
  const Scan scan = RandomScan(8, 80, 2);
  ScanBuilder builder(scan.uuid);
  EXPECT_EQ(builder.Partial().error().code, ErrorCode::kState);
  for (const Chunk& chunk : AllChunks(WithHealth(scan))) {
    const ChunkId& id = chunk.id;
    if (id.kind == ChunkKind::kRanges && id.item % 3 == 1) continue;
    if (id.kind == ChunkKind::kIntensities && id.item > 4) continue;
    if (id.kind == ChunkKind::kImage && id.item == 0) continue;
    if (id.kind == ChunkKind::kEnd) continue;
    ASSERT_TRUE(builder.Take(chunk));
  }
  const PartialScan partial = builder.Partial().value();
  EXPECT_EQ(partial.scan.state, ScanState::kRunning);
  EXPECT_EQ(partial.progress.lines, 56U);           // 7 of 10 blocks
  EXPECT_EQ(partial.progress.complete_lines, 24U);  // blocks 0, 2, 3
  EXPECT_FALSE(partial.progress.of_lines);
  ASSERT_EQ(partial.scan.lines.size(), 56U);
  EXPECT_EQ(partial.scan.lines[8], scan.lines[16]);
  EXPECT_EQ(partial.scan.lines.back().range_mm, scan.lines[79].range_mm);
  EXPECT_TRUE(partial.scan.lines.back().intensity.empty());
  EXPECT_TRUE(partial.scan.track == scan.track);
  ASSERT_EQ(partial.scan.frames.size(), 2U);
  EXPECT_EQ(partial.lossless, (std::vector{false, true}));
  EXPECT_EQ(partial.scan.frames[0].seq, scan.frames[0].seq);
  EXPECT_TRUE(partial.scan.frames[0].image.SameSize(scan.frames[0].image));
  EXPECT_EQ(partial.scan.frames[1], scan.frames[1]);
}

TEST(ScanBuilder, AStationThatKnowsTheRigNeedsNotFetchIt) {
  const Scan scan = RandomScan(9, 20, 0);
  ScanBuilder builder(scan.uuid);
  EXPECT_EQ(builder.UseRig(SensorRigToYaml(scan.rig)).error().code, ErrorCode::kState);
  for (const Chunk& chunk : AllChunks(WithHealth(scan)))
    if (chunk.id.kind != ChunkKind::kRig) {
      ASSERT_TRUE(builder.Take(chunk));
    }
  SensorRig other = scan.rig;
  other.name = "of the same id";
  EXPECT_EQ(builder.UseRig(SensorRigToYaml(other)).error().code, ErrorCode::kInvalidInput);
  ASSERT_TRUE(builder.UseRig(SensorRigToYaml(scan.rig)));
  EXPECT_TRUE(builder.Have().Has({ChunkKind::kRig, 0}));
  ExpectSame(builder.Whole().value(), scan);
}

TEST(ScanBuilder, AScanWithAnotherDigestIsRefusedAndNotEnded) {
  const Scan scan = RandomScan(10, 20, 0);
  ScanBuilder builder(scan.uuid);
  KeepingSink sink;
  for (const Chunk& chunk : AllChunks(WithHealth(scan))) {
    if (chunk.id.kind != ChunkKind::kEnd) {
      ASSERT_TRUE(builder.Take(chunk));
      continue;
    }
    ScanEnd end = DecodeEnd(chunk.bytes).value();
    end.digest[0] = end.digest[0] == '0' ? '1' : '0';
    ASSERT_TRUE(builder.Take(ChunkWith(chunk.id.Item(), EncodeEnd(end))));
  }
  builder.DeliverTo(sink);
  EXPECT_EQ(builder.Whole().error().code, ErrorCode::kBadData);
  EXPECT_EQ(sink.ended, 0);
}

TEST(ScanBuilder, RefusesTheHeaderOfAnotherScan) {
  const Scan scan = RandomScan(11, 1, 0);
  ScanBuilder builder("another");
  const auto taken = builder.Take(AllChunks({scan, ""}).front());
  EXPECT_EQ(taken.error().code, ErrorCode::kBadData);
  EXPECT_TRUE(builder.Have().empty());
}

TEST(ScanBuilder, AnItemThatCannotBeReadIsForgottenAndMayComeAgain) {
  const Scan scan = RandomScan(12, 8, 0);
  ScanBuilder builder(scan.uuid);
  const ItemId id{ChunkKind::kRanges, 0};
  EXPECT_EQ(builder.Take(ChunkWith(id, "nonsense")).error().code, ErrorCode::kBadData);
  EXPECT_FALSE(builder.Have().Has(id));
  EXPECT_TRUE(builder.Take(ChunkWith(id, EncodeItem({scan, ""}, id).value())));
  EXPECT_TRUE(builder.Have().Has(id));
}

TEST(ScanBuilder, PartsOfAnItemThatWasMadeAnewReplaceTheOldOnes) {
  ScanBuilder builder("some");
  // Random bytes: an image that cannot be read is told apart from parts that do not fit together.
  const auto old = SplitItem({ChunkKind::kImage, 0}, std::string(kMaxPartBytes + 9, 'x')).value();
  const auto anew = SplitItem({ChunkKind::kImage, 0}, std::string(kMaxPartBytes + 9, 'y')).value();
  EXPECT_TRUE(builder.Take(old[0]));
  EXPECT_TRUE(builder.Take(anew[1]));
  EXPECT_EQ(builder.Take(old[0]).value(), ScanBuilder::Taken::kNew) << "the old one again";
  EXPECT_FALSE(builder.Take(old[1])) << "whole, and no image";
}

TEST(ScanBuilder, APartThatContradictsTheNumberOfPartsIsRefused) {
  ScanBuilder builder("some");
  auto parts = SplitItem({ChunkKind::kImage, 0}, std::string(2 * kMaxPartBytes + 9, 'x')).value();
  EXPECT_TRUE(builder.Take(parts[0]));
  parts[1].parts = 4;
  parts[1].crc = ChunkCrc(parts[1]);
  EXPECT_EQ(builder.Take(parts[1]).error().code, ErrorCode::kBadData);
  EXPECT_TRUE(builder.Have().HasPart(parts[0].id, parts[0].item_crc));
}

TEST(ScanBuilder, HostileImagesAndTracksAreRefused) {
  ScanBuilder builder("some");
  const auto refused = [&](ChunkKind kind, const std::string& bytes) {
    return !builder.Take(ChunkWith({kind, 0}, bytes)).has_value();
  };
  ItemWriter frame;
  frame.U8(1).Signed(0);
  for (int i = 0; i < 5; ++i) frame.Double(0.0);
  const std::string head = frame.Take();
  // 20000 x 20000 pixels, and none of them.
  const std::string huge = ItemWriter().Raw(head).U8(1).Varint(20000).Varint(20000).U8(3).Take();
  EXPECT_TRUE(refused(ChunkKind::kImage, huge));
  // 5000 x 5000 pixels in a few bytes that end early.
  const std::string large = ItemWriter().Raw(head).U8(1).Varint(5000).Varint(5000).U8(3).Take();
  EXPECT_TRUE(refused(ChunkKind::kImage, large));
  EXPECT_TRUE(refused(ChunkKind::kTrack, ItemWriter().U8(1).U8(200).Take()));
  EXPECT_TRUE(refused(ChunkKind::kRig, ItemWriter().Varint(1U << 30).Take()));
  EXPECT_TRUE(refused(ChunkKind::kEnd, ItemWriter().U8(1).Text("running").Take()));
  Chunk second = ChunkWith({ChunkKind::kEnd, 1}, "x");
  EXPECT_FALSE(builder.Take(second)) << "a scan has one end";
}

}  // namespace
}  // namespace foresight
