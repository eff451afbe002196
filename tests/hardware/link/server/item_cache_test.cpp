#include "hardware/link/server/item_cache.h"

#include "hardware/head/scan_assembler.h"
#include "tests/hardware/link/chunks/random_scans.h"
#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

constexpr char kCachedScan[] = "a-scan";

class ItemCacheTest : public ::testing::Test {
 protected:
  ItemCacheTest() { Record(kCachedScan, 5); }

  void Record(const std::string& id, int seed) {
    Scan scan = samples::RandomScan(seed, 60, 3);
    scan.uuid = id;
    scan.state = ScanState::kComplete;
    scan.reason.clear();
    FakeHead head;
    EXPECT_TRUE(head.Home());
    EXPECT_TRUE(head.StartScan(ScanPlan(), shelf->Begin(id, {}).value()));
    head.Play(scan);
    EXPECT_TRUE(Eventually([&] { return shelf->Find(id).value().state != ScanState::kRunning; }));
  }
  ScanToSend Source(const std::string& id = kCachedScan) {
    return {*shelf->Snapshot(id).value(), shelf->DeviceHealthJson(id)};
  }
  /// Waits until no more is made.
  static bool Settled(const ItemCache& cache, std::int64_t at_least) {
    return Eventually([&] { return cache.Bytes() >= at_least; });
  }
  /// Of all items, encoded here.
  std::int64_t AllBytes() {
    const ScanToSend source = Source();
    ChunkSource all(source, {});
    std::int64_t bytes = 0;
    while (const auto chunk = all.Next().value())
      bytes += static_cast<std::int64_t>(chunk->bytes.size());
    return bytes;
  }

  const TemporaryFolder folder;
  const std::unique_ptr<ScanShelf> shelf = ScanShelf::Open({folder / "scans", 0.9}).value();
};

TEST_F(ItemCacheTest, WhatAStationWantsIsMadeBeforeItIsAskedFor) {
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  EXPECT_TRUE(Settled(cache, AllBytes()));
}

TEST_F(ItemCacheTest, TheItemsAreThoseOfTheEncoder) {
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  const ScanToSend source = Source();
  ChunkSource plain(source, {});
  while (const auto chunk = plain.Next().value()) {
    const SharedParts parts = cache.Get(source, chunk->id.Item()).value();
    const auto part = static_cast<std::size_t>(chunk->id.part);
    ASSERT_LT(part, parts->size());
    EXPECT_EQ((*parts)[part].bytes, chunk->bytes);
  }
}

TEST_F(ItemCacheTest, MadeAheadIsOnlySoMuch) {
  ItemCache cache(*shelf, 1);
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Settled(cache, 1));
  const std::int64_t one_item = cache.Bytes();
  EXPECT_LT(one_item, AllBytes());
  // What is asked for is made all the same.
  EXPECT_TRUE(cache.Get(Source(), {ChunkKind::kRig, 0}));
}

TEST_F(ItemCacheTest, WhatTheStationHasIsLetGoOf) {
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  const std::int64_t all = AllBytes();
  ASSERT_TRUE(Settled(cache, all));
  const ScanToSend source = Source();
  ChunkSource chunks(source, {});
  while (const auto chunk = chunks.Next().value()) cache.Acknowledged(kCachedScan, chunk->id);
  EXPECT_EQ(cache.Bytes(), 0);
}

TEST_F(ItemCacheTest, AStationThatComesBackHasWhatItSays) {
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Settled(cache, AllBytes()));
  ChunkSet have;
  const ScanToSend source = Source();
  ChunkSource chunks(source, {});
  while (const auto chunk = chunks.Next().value()) have.AddPart(*chunk);
  cache.Prepare(kCachedScan, have, {});
  EXPECT_EQ(cache.Bytes(), 0);
}

TEST_F(ItemCacheTest, AnotherScanTakesThePlaceOfTheFirst) {
  Record("another", 6);
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Settled(cache, AllBytes()));
  ChunkSet all;
  const ScanToSend source = Source("another");
  ChunkSource chunks(source, {});
  while (const auto chunk = chunks.Next().value()) all.AddPart(*chunk);
  cache.Prepare("another", all, {});
  EXPECT_EQ(cache.Bytes(), 0);
  // The first one's items are made without being kept.
  EXPECT_TRUE(cache.Get(Source(), {ChunkKind::kRig, 0}));
  EXPECT_EQ(cache.Bytes(), 0);
}

TEST_F(ItemCacheTest, AnItemThatCannotBeMadeSaysWhy) {
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  EXPECT_FALSE(cache.Get(Source(), {ChunkKind::kImage, 1000}));
}

/// An encoder that somebody holds up, as another program does that takes all cores.
struct HeldEncoder {
  ChunkSource::PartsOf Encode() {
    return [this](const ScanToSend& source, const ItemId& id) {
      const int call = ++calls;
      while (call <= held && !released) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return EncodeParts(source, id);
    };
  }

  int held = 1;  ///< of the first calls
  std::atomic<int> calls{0};
  std::atomic<bool> released{false};
};

TEST_F(ItemCacheTest, AStreamDoesNotWaitForAMakerThatGetsNoCore) {
  HeldEncoder encoder;
  encoder.held = 2;  // both makers
  ItemCache cache(*shelf, ItemCache::kUsualBytes, encoder.Encode());
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Eventually([&] { return encoder.calls == 2; }));
  const ScanToSend source = Source();
  const auto first = NextItem(source, ItemsOf(source), {}, {});
  const auto parts = cache.Get(source, *first);
  EXPECT_TRUE(parts);
  EXPECT_EQ(encoder.calls, 3);
  const std::int64_t one_item = cache.Bytes();
  for (const Chunk& chunk : **parts) cache.Acknowledged(kCachedScan, chunk.id);
  EXPECT_LT(cache.Bytes(), one_item);
  cache.Prepare(kCachedScan, {}, {});
  encoder.released = true;
  EXPECT_TRUE(Settled(cache, AllBytes())) << "the makers go on";
}

TEST_F(ItemCacheTest, WhatTwoMakeIsKeptOnce) {
  HeldEncoder encoder;
  encoder.held = 2;
  ItemCache cache(*shelf, ItemCache::kUsualBytes, encoder.Encode());
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Eventually([&] { return encoder.calls == 2; }));
  const ScanToSend source = Source();
  ChunkSource chunks(source, {},
                     [&](const ScanToSend& now, const ItemId& id) { return cache.Get(now, id); });
  while (const auto chunk = chunks.Next().value()) cache.Acknowledged(kCachedScan, chunk->id);
  encoder.released = true;
  EXPECT_FALSE(Eventually([&] { return cache.Bytes() > 0; }, 0.3)) << "nobody would ask for it";
}

TEST_F(ItemCacheTest, WhileAScanIsRecordedOneMakerWaitsForTheSweep) {
  FakeHead head;
  ASSERT_TRUE(head.Home());
  ASSERT_TRUE(head.StartScan(ScanPlan(), shelf->Begin("another", {}).value()));
  HeldEncoder encoder;
  ItemCache cache(*shelf, ItemCache::kUsualBytes, encoder.Encode());
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Eventually([&] { return encoder.calls == 1; }));
  EXPECT_FALSE(Eventually([&] { return encoder.calls == 2; }, 0.3));
  shelf->Withdraw("another");
  EXPECT_TRUE(Eventually([&] { return encoder.calls > 1; })) << "the sweep is over";
  encoder.released = true;
}

TEST_F(ItemCacheTest, AForgottenScanLeavesNothing) {
  ItemCache cache(*shelf);
  cache.Prepare(kCachedScan, {}, {});
  ASSERT_TRUE(Settled(cache, AllBytes()));
  cache.Forget(kCachedScan);
  EXPECT_EQ(cache.Bytes(), 0);
}

}  // namespace
}  // namespace foresight
