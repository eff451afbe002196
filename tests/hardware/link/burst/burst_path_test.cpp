// A scan from carousel to builder, without sockets: every loss is the test's.
#include <gtest/gtest.h>

#include <cstdio>

#include "hardware/link/burst/burst_carousel.h"
#include "hardware/link/burst/burst_receiver.h"
#include "hardware/link/chunks/scan_builder.h"
#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

using samples::RandomScan;
using samples::WithHealth;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kStride =
    static_cast<std::uint32_t>(kMostDatagramBytes - kDatagramSealBytes - kFragmentHeadBytes);

/// A head's and a station's end, and what the path between them does.
class BurstPath : public ::testing::Test {
 protected:
  BurstPath() { EXPECT_TRUE(reader.Expect(key, source.scan.uuid, {})); }

  std::vector<Bytes> SealedRound(BurstCarousel& carousel) {
    std::vector<Bytes> datagrams;
    Bytes content;
    carousel.BeginRound();
    while (const auto chunk = carousel.Next()) {
      for (std::uint32_t i = 0; i < FragmentCount(*chunk, kStride); ++i) {
        WriteFragment(BurstScanTag(source.scan.uuid), *chunk, kStride, i, content);
        EXPECT_TRUE(sealer.Seal(content, datagrams.emplace_back()));
        sent_bytes += datagrams.back().size();
      }
    }
    return datagrams;
  }
  BurstCarousel Carousel() const {
    BurstCarousel carousel(source, {});
    while (const auto id = carousel.NextToEncode())
      carousel.Add(*id, SplitItem(*id, EncodeItem(source, *id).value()).value());
    return carousel;
  }
  void TakeIn() {
    for (const Chunk& chunk : reader.TakeChunks()) EXPECT_TRUE(builder.Take(chunk));
    reader.SetHave(builder.Have());
  }
  /// Rounds until the scan is whole, with the station's word after each; 0 = never.
  int RoundsWithLoss(double ratio, std::uint64_t seed) {
    Random random(seed);
    BurstCarousel carousel = Carousel();
    for (int round = 1; round <= 100; ++round) {
      for (const Bytes& datagram : SealedRound(carousel))
        if (random.Uniform() >= ratio) reader.Take(datagram);
      TakeIn();
      if (builder.Progress().complete) return round;
      carousel.SetHave(builder.Have());
    }
    return 0;
  }

  const ScanToSend source = WithHealth(RandomScan(11, 400, 8));
  const BurstKey key = BurstKey::Make().value();
  DatagramSealer sealer = DatagramSealer::Make(key).value();
  BurstReader reader;
  ScanBuilder builder{source.scan.uuid};
  std::size_t sent_bytes = 0;
};

TEST_F(BurstPath, AScanIsTheSameAtTheOtherEnd) {
  EXPECT_EQ(RoundsWithLoss(0.0, 1), 1);
  EXPECT_EQ(ScanDigest(builder.Whole().value()), ScanDigest(source.scan));
  EXPECT_EQ(reader.counts().Refused(), 0);
}

TEST_F(BurstPath, LostShuffledAndRepeatedDatagramsMakeTheSameScan) {
  Random random(5);
  BurstCarousel carousel = Carousel();
  for (int round = 0; round < 100 && !builder.Progress().complete; ++round) {
    std::vector<Bytes> datagrams = SealedRound(carousel);
    // Within what a path reorders, and each third one twice.
    for (std::size_t i = 0; i + 50 < datagrams.size(); ++i)
      std::swap(datagrams[i], datagrams[i + static_cast<std::size_t>(random.Index(50))]);
    for (std::size_t i = 0; i < datagrams.size(); ++i) {
      if (random.Index(4) == 0) continue;
      reader.Take(datagrams[i]);
      if (i % 3 == 0) reader.Take(datagrams[i]);
    }
    TakeIn();
    carousel.SetHave(builder.Have());
  }
  EXPECT_EQ(ScanDigest(builder.Whole().value()), ScanDigest(source.scan));
  EXPECT_GT(reader.counts().replayed, 0);
  EXPECT_EQ(reader.counts().forged, 0);
}

TEST_F(BurstPath, LossCostsRoundsOfWhatIsMissingOnly) {
  BurstPath::RoundsWithLoss(0.0, 1);
  const std::size_t without = sent_bytes;
  struct Case {
    double loss;
    int rounds;
    double bytes;
  };
  // A chunk has up to 45 fragments, and all of a chunk that misses one go again: at 1 % a third of
  // them in the second round, at 20 % nearly all, in each round fewer.
  for (const Case& c : {Case{0.01, 4, 1.7}, Case{0.05, 5, 2.5}, Case{0.2, 9, 5.0}}) {
    reader = {};
    builder = ScanBuilder(source.scan.uuid);
    ASSERT_TRUE(reader.Expect(key, source.scan.uuid, {}));
    sent_bytes = 0;
    const int rounds = RoundsWithLoss(c.loss, 17);
    const double ratio = static_cast<double>(sent_bytes) / static_cast<double>(without);
    EXPECT_GT(rounds, 1);
    EXPECT_LE(rounds, c.rounds);
    EXPECT_LE(ratio, c.bytes);
    std::printf("loss %.2f: %d rounds, %.2f times the bytes\n", c.loss, rounds, ratio);
  }
}

TEST_F(BurstPath, WhatIsRefusedChangesNothing) {
  Random random(9);
  BurstCarousel carousel = Carousel();
  DatagramSealer stranger = DatagramSealer::Make(BurstKey::Make().value()).value();
  for (const Bytes& datagram : SealedRound(carousel)) {
    Bytes forged = datagram;
    forged[static_cast<std::size_t>(random.Index(static_cast<int>(forged.size())))] ^=
        static_cast<std::uint8_t>(1 + random.Index(255));
    reader.Take(forged);
    Bytes cut(datagram.begin(), datagram.begin() + random.Index(static_cast<int>(datagram.size())));
    reader.Take(cut);
    Bytes foreign;
    ASSERT_TRUE(stranger.Seal(Bytes(100), foreign));
    reader.Take(foreign);
    reader.Take(datagram);
    reader.Take(datagram);
  }
  const BurstCounts& counts = reader.counts();
  EXPECT_EQ(counts.replayed, counts.datagrams) << "each good one came twice";
  EXPECT_EQ(counts.foreign + counts.forged, 3 * counts.datagrams);
  TakeIn();
  EXPECT_EQ(ScanDigest(builder.Whole().value()), ScanDigest(source.scan));
}

TEST_F(BurstPath, ADatagramOfAnotherScanIsLeftAlone) {
  BurstCarousel carousel = Carousel();
  ASSERT_TRUE(reader.Expect(key, "another-scan", {}));
  for (const Bytes& datagram : SealedRound(carousel)) reader.Take(datagram);
  EXPECT_TRUE(reader.TakeChunks().empty());
  EXPECT_EQ(reader.counts().Refused(), 0);
}

TEST_F(BurstPath, BeforeAKeyIsThereEverythingIsForeign) {
  BurstReader closed;
  BurstCarousel carousel = Carousel();
  const auto datagrams = SealedRound(carousel);
  for (const Bytes& datagram : datagrams) closed.Take(datagram);
  EXPECT_EQ(closed.counts().foreign, static_cast<std::int64_t>(datagrams.size()));
  EXPECT_TRUE(closed.TakeChunks().empty());
}

TEST_F(BurstPath, ChunksThatAreKeptAreNotMadeAgain) {
  RoundsWithLoss(0.0, 1);
  const std::int64_t before = reader.counts().chunks;
  BurstCarousel carousel = Carousel();
  for (const Bytes& datagram : SealedRound(carousel)) reader.Take(datagram);
  EXPECT_TRUE(reader.TakeChunks().empty());
  EXPECT_EQ(reader.counts().chunks, before);
}

}  // namespace
}  // namespace foresight
