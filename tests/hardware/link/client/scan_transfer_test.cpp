#include "hardware/link/client/scan_transfer.h"

#include <numeric>

#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/link/chunks/random_scans.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

class ScanTransferTest : public ::testing::Test {
 protected:
  ScanTransferTest() {
    ChunkSource source(ScanToSend{scan, ""}, {});
    while (auto chunk = source.Next().value()) chunks.push_back(std::move(*chunk));
  }
  std::unique_ptr<ScanTransfer> Open() const {
    return ScanTransfer::Open(folder / "spool", scan.uuid, "").value();
  }
  std::int64_t Bytes() const {
    return std::accumulate(chunks.begin(), chunks.end(), std::int64_t{0},
                           [](std::int64_t sum, const Chunk& chunk) {
                             return sum + static_cast<std::int64_t>(chunk.bytes.size());
                           });
  }

  const TemporaryFolder folder;
  const Scan scan = [] {
    Scan made = samples::RandomScan(7, 40, 2);
    made.state = ScanState::kComplete;
    made.reason.clear();
    return made;
  }();
  std::vector<Chunk> chunks;
};

TEST_F(ScanTransferTest, WhatWasKeptIsHadAndNotAskedForAgainWhileItWaits) {
  const auto transfer = Open();
  const auto kept = transfer->Keep(chunks).value();
  ASSERT_EQ(kept.size(), chunks.size());
  EXPECT_EQ(transfer->WaitingBytes(), Bytes());
  EXPECT_EQ(transfer->builder().Progress().lines, 0) << "nothing was taken in yet";
  const ChunkSet have = transfer->Have();
  for (const Chunk& chunk : chunks) EXPECT_TRUE(have.HasPart(chunk.id, chunk.item_crc));
}

TEST_F(ScanTransferTest, WhatWaitedBecomesTheScan) {
  const auto transfer = Open();
  ASSERT_TRUE(transfer->Keep(chunks));
  while (transfer->Waiting()) EXPECT_TRUE(transfer->TakeInNext());
  EXPECT_EQ(transfer->WaitingBytes(), 0);
  EXPECT_EQ(transfer->TakenBytes(), Bytes());
  EXPECT_EQ(ScanDigest(transfer->builder().Whole().value()), ScanDigest(scan));
}

TEST_F(ScanTransferTest, WhatWaitedWhenTheProgramDiedIsThereAfterwards) {
  ASSERT_TRUE(Open()->Keep(chunks));
  const auto transfer = Open();
  EXPECT_FALSE(transfer->Waiting());
  EXPECT_EQ(ScanDigest(transfer->builder().Whole().value()), ScanDigest(scan));
}

TEST_F(ScanTransferTest, ADamagedChunkIsNotAcknowledged) {
  const auto transfer = Open();
  Chunk damaged = chunks.front();
  damaged.bytes.back() = static_cast<char>(damaged.bytes.back() ^ 1);
  EXPECT_TRUE(transfer->Keep({damaged}).value().empty());
  EXPECT_FALSE(transfer->Waiting());
}

TEST_F(ScanTransferTest, WhatCannotBeReadHasToComeAgain) {
  const auto transfer = Open();
  // Of sound sums, and no header.
  auto false_header = SplitItem({ChunkKind::kHeader, 0}, "no header at all").value();
  ASSERT_TRUE(transfer->Keep(false_header));
  EXPECT_TRUE(transfer->Have().HasPart(false_header[0].id, false_header[0].item_crc));
  EXPECT_FALSE(transfer->TakeInNext());
  EXPECT_FALSE(transfer->Have().Has({ChunkKind::kHeader, 0}));
}

}  // namespace
}  // namespace foresight
