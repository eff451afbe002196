#include "hardware/link/burst/burst_carousel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

using samples::RandomScan;
using samples::WithHealth;

void EncodeAll(BurstCarousel& carousel) {
  while (const auto id = carousel.NextToEncode())
    carousel.Add(*id, SplitItem(*id, EncodeItem(carousel.source(), *id).value()).value());
}

std::vector<ChunkId> Round(BurstCarousel& carousel) {
  std::vector<ChunkId> ids;
  while (const auto chunk = carousel.Next()) ids.push_back(chunk->id);
  return ids;
}

/// What a stream over a wide path sends, in its order.
std::vector<ChunkId> OfAStream(const ScanToSend& source) {
  ChunkSource stream(source, {});
  std::vector<ChunkId> ids;
  for (auto chunk = stream.Next().value(); chunk; chunk = stream.Next().value())
    ids.push_back(chunk->id);
  return ids;
}

TEST(BurstCarousel, SendsTheScanInTheOrderOfAStreamAndThenAgain) {
  const ScanToSend source = WithHealth(RandomScan(4, 100, 3));
  BurstCarousel carousel(source, {});
  EncodeAll(carousel);
  const auto first = Round(carousel);
  EXPECT_EQ(first, OfAStream(source));
  EXPECT_TRUE(Round(carousel).empty()) << "a round ends";
  carousel.BeginRound();
  EXPECT_EQ(Round(carousel), first);
}

TEST(BurstCarousel, LeavesOutWhatTheStationHas) {
  const ScanToSend source = WithHealth(RandomScan(4, 100, 3));
  BurstCarousel carousel(source, {});
  EncodeAll(carousel);
  const std::size_t bytes = carousel.bytes();
  const auto all = Round(carousel);
  ChunkSet have;
  for (std::size_t i = 0; i < all.size(); i += 2) have.Add(all[i].Item());
  carousel.SetHave(have);
  EXPECT_LT(carousel.bytes(), bytes) << "what is there needs no memory here";
  carousel.BeginRound();
  for (const ChunkId& id : Round(carousel)) EXPECT_FALSE(have.Has(id.Item()));
  EXPECT_FALSE(carousel.NextToEncode());
  for (const ChunkId& id : all) have.Add(id.Item());
  carousel.SetHave(have);
  carousel.BeginRound();
  EXPECT_TRUE(Round(carousel).empty());
  EXPECT_EQ(carousel.bytes(), 0u);
}

TEST(BurstCarousel, SendsAgainWhatTheStationCouldNotRead) {
  const ScanToSend source = WithHealth(RandomScan(4, 20, 0));
  ChunkSet have;
  have.Add(ItemId{ChunkKind::kRanges, 0});
  BurstCarousel carousel(source, have);
  carousel.SetHave({});
  EncodeAll(carousel);
  carousel.BeginRound();
  const auto round = Round(carousel);
  EXPECT_TRUE(std::any_of(round.begin(), round.end(), [](const ChunkId& id) {
    return id.Item() == ItemId{ChunkKind::kRanges, 0};
  }));
}

TEST(BurstCarousel, SendsWhatIsEncodedAndWaitsForNothing) {
  BurstCarousel carousel(WithHealth(RandomScan(4, 100, 3)), {});
  EXPECT_FALSE(carousel.Next());
  const ItemId first = carousel.NextToEncode().value();
  EXPECT_EQ(first.kind, ChunkKind::kHeader);
  carousel.Add(first, SplitItem(first, EncodeItem(carousel.source(), first).value()).value());
  carousel.BeginRound();
  EXPECT_EQ(Round(carousel).size(), 1u);
  carousel.LeaveOut(carousel.NextToEncode().value());
  EXPECT_EQ(carousel.NextToEncode()->kind, ChunkKind::kEnd) << "the rig was left out";
}

TEST(BurstCarousel, EncodesNoMoreThanItsMemoryHolds) {
  const ScanToSend source = WithHealth(RandomScan(4, 200, 4));
  BurstCarousel carousel(source, {}, 20'000);
  EncodeAll(carousel);
  const auto some = Round(carousel);
  EXPECT_LT(some.size(), OfAStream(source).size());
  // Round by round, all of it goes.
  std::set<ChunkId> sent;
  ChunkSet have;
  for (int round = 0; round < 500 && carousel.bytes() > 0; ++round) {
    carousel.BeginRound();
    while (const auto chunk = carousel.Next()) {
      sent.insert(chunk->id);
      have.AddPart(*chunk);
    }
    carousel.SetHave(have);
    EncodeAll(carousel);
  }
  for (const ChunkId& id : OfAStream(source))
    if (id.kind == ChunkKind::kImage || id.kind == ChunkKind::kRanges) {
      EXPECT_EQ(sent.count(id), 1u);
    }
}

TEST(BurstCarousel, ANewLineIsSentInTheSameRound) {
  Scan scan = RandomScan(4, 16, 0);
  scan.state = ScanState::kRunning;
  Scan begun = scan;
  begun.lines.clear();
  BurstCarousel carousel(ScanToSend{begun, ""}, {});
  EncodeAll(carousel);
  Round(carousel);
  carousel.Update(ScanToSend{scan, ""});
  EncodeAll(carousel);
  const auto more = Round(carousel);
  EXPECT_TRUE(std::any_of(more.begin(), more.end(),
                          [](const ChunkId& id) { return id.kind == ChunkKind::kRanges; }));
}

}  // namespace
}  // namespace foresight
