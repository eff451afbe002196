#include "hardware/link/chunks/chunk_set.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

NumberSet::Interval RandomInterval(Random& random, int end) {
  const int first = random.Index(end);
  return {first, std::min(end - 1, first + random.Index(6))};
}

TEST(NumberSet, HoldsWhatWasAddedAsFewestIntervals) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    NumberSet set;
    std::set<std::int64_t> expected;
    for (int i = 0; i < random.Index(40); ++i) {
      const auto interval = RandomInterval(random, 100);
      set.Add(interval);
      for (std::int64_t n = interval.first; n <= interval.last; ++n) expected.insert(n);
    }
    std::int64_t before = -2;
    for (const auto& interval : set.Intervals()) {
      ASSERT_GT(interval.first, before + 1) << "intervals touch";
      before = interval.last;
    }
    for (std::int64_t n = -1; n <= 100; ++n) ASSERT_EQ(set.Has(n), expected.count(n) == 1) << n;
    ASSERT_EQ(set.Count(), static_cast<std::int64_t>(expected.size()));
  }
}

ChunkSet RandomSet(Random& random) {
  ChunkSet set;
  for (int i = 0; i < random.Index(30); ++i)
    set.Add(static_cast<ChunkKind>(1 + random.Index(kChunkKinds)), RandomInterval(random, 3000));
  for (int i = 0; i < random.Index(5); ++i) {
    const auto parts =
        SplitItem({ChunkKind::kImage, 10000 + i}, std::string(5 * kMaxPartBytes, 'x')).value();
    for (const Chunk& part : parts)
      if (random.Index(2) == 0) set.AddPart(part);
  }
  return set;
}

TEST(ChunkSet, SurvivesBeingSent) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const ChunkSet set = RandomSet(random);
    const auto back = ChunkSet::Decode(set.Encode());
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_TRUE(*back == set) << seed;
  }
}

TEST(ChunkSet, OfAWholeScanTakesFewBytes) {
  ChunkSet set;
  for (int kind = 1; kind <= kChunkKinds; ++kind) set.Add(static_cast<ChunkKind>(kind), {0, 1000});
  EXPECT_LT(set.Encode().size(), 100U);
}

TEST(ChunkSet, WithAnotherOneHasWhatEitherHas) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const ChunkSet one = RandomSet(random), other = RandomSet(random);
    ChunkSet both = one;
    both.Add(other);
    for (int kind = 1; kind <= kChunkKinds; ++kind)
      for (std::int64_t item = 0; item < 3000; ++item) {
        const ItemId id{static_cast<ChunkKind>(kind), item};
        ASSERT_EQ(both.Has(id), one.Has(id) || other.Has(id)) << seed;
      }
    const auto parts =
        SplitItem({ChunkKind::kImage, 10000}, std::string(5 * kMaxPartBytes, 'x')).value();
    for (const Chunk& part : parts)
      ASSERT_EQ(both.HasPart(part.id, part.item_crc),
                one.HasPart(part.id, part.item_crc) || other.HasPart(part.id, part.item_crc));
  }
}

TEST(ChunkSet, TheLastPartMakesAnItemWhole) {
  ChunkSet set;
  const auto parts = SplitItem({ChunkKind::kImage, 2}, std::string(kMaxPartBytes + 1, 'x')).value();
  set.AddPart(parts[1]);
  EXPECT_FALSE(set.Has({ChunkKind::kImage, 2}));
  EXPECT_TRUE(set.HasPart(parts[1].id, parts[1].item_crc));
  EXPECT_FALSE(set.HasPart(parts[0].id, parts[0].item_crc));
  set.AddPart(parts[0]);
  EXPECT_TRUE(set.Has({ChunkKind::kImage, 2}));
  EXPECT_TRUE(set.partial().empty());
}

TEST(ChunkSet, PartsOfAnItemThatWasMadeAnewReplaceTheOldOnes) {
  ChunkSet set;
  const auto old = SplitItem({ChunkKind::kImage, 2}, std::string(kMaxPartBytes + 1, 'x')).value();
  const auto anew = SplitItem({ChunkKind::kImage, 2}, std::string(kMaxPartBytes + 1, 'y')).value();
  set.AddPart(old[0]);
  set.AddPart(anew[1]);
  EXPECT_FALSE(set.Has({ChunkKind::kImage, 2}));
  EXPECT_FALSE(set.HasPart(old[0].id, old[0].item_crc));
  EXPECT_TRUE(set.HasPart(anew[1].id, anew[1].item_crc));
}

TEST(ChunkSet, DamagedSetsAreRefusedOrReadAsSets) {
  Random random(9);
  const std::string good = RandomSet(random).Encode();
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bad = good;
    const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(bad.size())));
    if (trial % 2 == 0)
      bad[at] = static_cast<char>(bad[at] ^ 1 << random.Index(8));
    else
      bad.resize(at);
    if (const auto read = ChunkSet::Decode(bad)) {
      const auto again = ChunkSet::Decode(read->Encode());
      ASSERT_TRUE(again && *again == *read);
    }
  }
}

TEST(ChunkSet, ItemsBeyondTheLimitAreRefused) {
  const std::string bytes = ItemWriter()
                                .U8(1)
                                .Varint(1)
                                .U8(static_cast<std::uint8_t>(ChunkKind::kRanges))
                                .Varint(1)
                                .Varint(0)
                                .Varint(static_cast<std::uint64_t>(kMaxItems))
                                .Varint(0)
                                .Take();
  EXPECT_EQ(ChunkSet::Decode(bytes).error().code, ErrorCode::kBadData);
}

}  // namespace
}  // namespace foresight
