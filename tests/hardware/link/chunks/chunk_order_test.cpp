#include "hardware/link/chunks/chunk_order.h"

#include <gtest/gtest.h>

#include "hardware/link/chunks/chunk_source.h"
#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

using samples::RandomScan;
using samples::WithHealth;

/// What goes over the path, item by item.
std::vector<ItemId> OrderOf(const ScanToSend& source, const TransferPreferences& preferences,
                            ChunkSet done = {}) {
  std::vector<ItemId> order;
  const ItemCounts counts = ItemsOf(source);
  while (const auto id = NextItem(source, counts, done, preferences)) {
    EXPECT_TRUE(MayTravel(*id, counts, done, preferences));
    order.push_back(*id);
    done.Add(*id);
  }
  for (int kind = 1; kind <= kChunkKinds; ++kind)
    for (std::int64_t item = 0; item < counts[static_cast<ChunkKind>(kind)]; ++item)
      EXPECT_FALSE(MayTravel({static_cast<ChunkKind>(kind), item}, counts, done, preferences));
  return order;
}

std::vector<ChunkKind> KindsOf(const std::vector<ItemId>& order) {
  std::vector<ChunkKind> kinds;
  for (const ItemId& id : order)
    if (kinds.empty() || kinds.back() != id.kind) kinds.push_back(id.kind);
  return kinds;
}

std::vector<std::int64_t> ItemsOfKind(const std::vector<ItemId>& order, ChunkKind kind) {
  std::vector<std::int64_t> items;
  for (const ItemId& id : order)
    if (id.kind == kind) items.push_back(id.item);
  return items;
}

TEST(ChunkOrder, GoesFromWhatIsNeededFirstToWhatOnlyTheRecordNeeds) {
  const auto order = OrderOf(WithHealth(RandomScan(1, 200, 2)), {});
  using enum ChunkKind;
  EXPECT_EQ(KindsOf(order),
            (std::vector{kHeader, kRig, kEnd, kCoarseCloud, kThumbnail, kCoarseCloud, kThumbnail,
                         kCoarseCloud, kTrack, kDeviceHealth, kPreview, kRanges, kJpeg,
                         kIntensities, kImage}));
}

TEST(ChunkOrder, AThinPathCarriesTheSmallThingsOnly) {
  TransferPreferences preferences;
  preferences.bytes_per_s = 1200.0;
  using enum ChunkKind;
  EXPECT_EQ(KindsOf(OrderOf(WithHealth(RandomScan(1, 200, 2)), preferences)),
            (std::vector{kHeader, kRig, kEnd, kCoarseCloud, kThumbnail, kCoarseCloud, kThumbnail,
                         kCoarseCloud}));
}

TEST(ChunkOrder, AnImageOnRequestGoesOverAThinPathToo) {
  TransferPreferences preferences;
  preferences.bytes_per_s = 1200.0;
  preferences.images_first = {1, 77, -1};
  const auto order = OrderOf(WithHealth(RandomScan(1, 200, 2)), preferences);
  EXPECT_EQ(order.back(), (ItemId{ChunkKind::kImage, 1}));
}

TEST(ChunkOrder, AnImageOnRequestGoesBeforeLines) {
  TransferPreferences preferences;
  preferences.images_first = {1};
  const auto order = OrderOf(WithHealth(RandomScan(1, 200, 2)), preferences);
  const auto at = [&](const ItemId& id) { return std::find(order.begin(), order.end(), id); };
  EXPECT_LT(at({ChunkKind::kImage, 1}), at({ChunkKind::kTrack, 0}));
  EXPECT_EQ(at({ChunkKind::kPreview, 1}), order.end()) << "the image is better";
  EXPECT_GT(at({ChunkKind::kImage, 0}), at({ChunkKind::kIntensities, 0}));
}

TEST(ChunkOrder, APathOfMiddlingRateGetsAFineCloud) {
  TransferPreferences preferences;
  preferences.bytes_per_s = 50'000.0;
  const auto order = OrderOf(WithHealth(RandomScan(1, 200, 2)), preferences);
  EXPECT_EQ(ItemsOfKind(order, ChunkKind::kFineCloud).size(), 4U);
}

TEST(ChunkOrder, EveryPrefixOfTheLinesCoversTheScope) {
  const auto blocks = ItemsOfKind(OrderOf({RandomScan(1, 440, 0), ""}, {}), ChunkKind::kRanges);
  ASSERT_EQ(blocks.size(), 55U);
  for (std::size_t count = 4; count <= blocks.size(); ++count) {
    std::vector<std::int64_t> prefix(blocks.begin(),
                                     blocks.begin() + static_cast<std::ptrdiff_t>(count));
    std::sort(prefix.begin(), prefix.end());
    std::int64_t widest = prefix.front() + 1;
    for (std::size_t i = 1; i < count; ++i) widest = std::max(widest, prefix[i] - prefix[i - 1]);
    // Halves of halves: at most twice the even spacing of 64, the next power of two.
    EXPECT_LE(widest, 2 * 64 / static_cast<std::int64_t>(count)) << count;
  }
}

TEST(ChunkOrder, EveryItemGoesOnce) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ScanToSend source = WithHealth(RandomScan(seed, static_cast<int>(seed) * 37, 3));
    auto order = OrderOf(source, {});
    const ItemCounts counts = ItemsOf(source);
    for (const ChunkKind kind :
         {ChunkKind::kTrack, ChunkKind::kRanges, ChunkKind::kIntensities, ChunkKind::kImage})
      EXPECT_EQ(static_cast<std::int64_t>(ItemsOfKind(order, kind).size()), counts[kind]);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(std::adjacent_find(order.begin(), order.end()), order.end());
  }
}

TEST(ChunkOrder, LinesOfTheRegionOfInterestGoFirst) {
  const Scan scan = RandomScan(1, 440, 0);
  TransferPreferences preferences;
  // Lines 100 to 140 lie in blocks 12 to 17; seq jumps where lines are lost.
  preferences.lines_first = NumberSet::Interval{scan.lines[100].seq, scan.lines[140].seq};
  auto blocks = ItemsOfKind(OrderOf({scan, ""}, preferences), ChunkKind::kRanges);
  ASSERT_EQ(blocks.size(), 55U);
  std::sort(blocks.begin(), blocks.begin() + 6);
  EXPECT_EQ(std::vector(blocks.begin(), blocks.begin() + 6),
            (std::vector<std::int64_t>{12, 13, 14, 15, 16, 17}));
}

TEST(ChunkOrder, ARegionWithoutLinesChangesNothing) {
  const Scan scan = RandomScan(1, 100, 0);
  TransferPreferences preferences;
  for (const NumberSet::Interval region :
       {NumberSet::Interval{INT64_MAX, INT64_MAX}, NumberSet::Interval{INT64_MIN, -1},
        NumberSet::Interval{9, 3}}) {
    preferences.lines_first = region;
    EXPECT_EQ(OrderOf({scan, ""}, preferences), OrderOf({scan, ""}, {}));
  }
}

TEST(ChunkOrder, NoCloudGoesOnceItsLinesAreThere) {
  const ScanToSend source{RandomScan(1, 200, 1), ""};
  ChunkSet done;
  done.Add(ChunkKind::kRanges, {0, 7});  // lines 0 to 63
  done.Add({ChunkKind::kImage, 0});
  const auto order = OrderOf(source, {}, done);
  EXPECT_EQ(ItemsOfKind(order, ChunkKind::kCoarseCloud), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_TRUE(ItemsOfKind(order, ChunkKind::kThumbnail).empty());
}

TEST(ChunkSource, SomethingUrgentGoesBetweenThePartsOfAnImage) {
  Scan scan = RandomScan(1, 20, 0);
  Random random(3);
  CameraFrame frame = samples::RandomFrame(random, 0);
  frame.image = ColorImage(300, 300);
  for (Rgb8& pixel : frame.image.values())
    pixel = {static_cast<std::uint8_t>(random.Index(256)), 0,
             static_cast<std::uint8_t>(random.Index(256))};
  scan.frames.push_back(frame);
  ChunkSource source({scan, ""}, {});
  Chunk chunk;
  while (chunk.id.kind != ChunkKind::kImage) chunk = source.Next().value().value();
  ASSERT_GT(chunk.parts, 2);
  TransferPreferences preferences;
  preferences.bytes_per_s = 50'000.0;  // fine clouds are of use now
  source.SetPreferences(preferences);
  EXPECT_EQ(source.Next().value()->id.kind, ChunkKind::kImage) << "all its lines have gone";
  scan.frames.push_back(frame);
  source.Update({scan, ""});
  EXPECT_EQ(source.Next().value()->id, (ChunkId{ChunkKind::kThumbnail, 1, 0}));
}

TEST(ChunkSource, LeavesOutWhatTheStationHasDownToTheParts) {
  const ScanToSend sent = WithHealth(RandomScan(2, 100, 3));
  Random random(7);
  for (int trial = 0; trial < 10; ++trial) {
    ChunkSource first(sent, {});
    ChunkSet have;
    std::vector<Chunk> got;
    const int count = random.Index(60);
    for (int i = 0; i < count; ++i) {
      const auto chunk = first.Next().value();
      if (!chunk) break;
      have.AddPart(*chunk);
      got.push_back(*chunk);
    }
    ChunkSource second(sent, ChunkSet::Decode(have.Encode()).value());
    int came = 0;
    const bool expects_more = second.LeftBytes() > 0;
    while (const auto chunk = second.Next().value()) {
      for (const Chunk& before : got) ASSERT_FALSE(before.id == chunk->id) << Describe(*chunk);
      got.push_back(*chunk);
      ++came;
    }
    EXPECT_EQ(expects_more, came > 0);
    EXPECT_EQ(second.LeftBytes(), 0);
  }
}

TEST(ChunkSource, LeavesOutWhatComesByAnotherWayMeanwhile) {
  const ScanToSend scan{RandomScan(6, 40, 1), ""};
  ChunkSource source(scan, {});
  const Chunk first = **source.Next();
  ChunkSet have;
  for (int kind = 1; kind <= kChunkKinds; ++kind) have.Add(static_cast<ChunkKind>(kind), {0, 1000});
  source.AddHave(have);
  EXPECT_EQ(first.id.kind, ChunkKind::kHeader);
  EXPECT_FALSE(*source.Next());
  EXPECT_EQ(source.LeftBytes(), 0);
}

TEST(ChunkSource, AnItemThatCannotBeMadeDoesNotHoldUpTheOthers) {
  Scan scan = RandomScan(2, 16, 0);
  scan.lines.Edit(0).time_s = INFINITY;
  ChunkSource source({scan, ""}, {});
  int failures = 0, chunks = 0;
  for (;;) {
    const auto chunk = source.Next();
    if (!chunk) {
      ++failures;
      continue;
    }
    if (!*chunk) break;
    ++chunks;
  }
  EXPECT_EQ(failures, 2) << "ranges and intensities of the block";
  EXPECT_GT(chunks, 5);
}

}  // namespace
}  // namespace foresight
