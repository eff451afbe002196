#include "hardware/link/client/early_scan.h"

#include <gtest/gtest.h>

#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

using samples::AllChunks;
using samples::KeepingSink;
using samples::RandomScan;
using samples::WithHealth;

class EarlyScanTest : public ::testing::Test {
 protected:
  void Take(std::initializer_list<ChunkKind> kinds, std::int64_t item = -1) {
    for (const Chunk& chunk : AllChunks(WithHealth(scan))) {
      const bool wanted = std::find(kinds.begin(), kinds.end(), chunk.id.kind) != kinds.end();
      if (!wanted || (item >= 0 && chunk.id.item != item)) continue;
      ASSERT_TRUE(builder.Take(chunk));
    }
    builder.DeliverTo(sink);
  }

  const Scan scan = RandomScan(7, 100, 2);
  ScanBuilder builder{scan.uuid};
  KeepingSink sink;
};

TEST_F(EarlyScanTest, NothingCameBeyondWhatTheSinkHeard) {
  EXPECT_EQ(EarlyScanOf(builder), nullptr);
  Take({ChunkKind::kHeader, ChunkKind::kRig});
  EXPECT_EQ(EarlyScanOf(builder), nullptr);
  Take({ChunkKind::kTrack});
  Take({ChunkKind::kRanges, ChunkKind::kIntensities}, 0);
  ASSERT_FALSE(sink.scan.lines.empty());
  EXPECT_EQ(EarlyScanOf(builder), nullptr);
}

TEST_F(EarlyScanTest, LinesBehindAGapAreThereBeforeTheSinkHearsOfThem) {
  Take({ChunkKind::kHeader, ChunkKind::kRig, ChunkKind::kTrack});
  Take({ChunkKind::kRanges}, 3);
  EXPECT_TRUE(sink.scan.lines.empty());
  const auto early = EarlyScanOf(builder);
  ASSERT_NE(early, nullptr);
  EXPECT_GT(early->lines, 0);
  EXPECT_EQ(early->scan->lines.size(), static_cast<std::size_t>(early->lines));
  EXPECT_EQ(early->scan->state, ScanState::kRunning);
  EXPECT_EQ(early->cloud, nullptr);
}

TEST_F(EarlyScanTest, ACoarseCloudIsThereBeforeAnyLine) {
  Take({ChunkKind::kHeader, ChunkKind::kRig});
  Take({ChunkKind::kCoarseCloud});
  const auto early = EarlyScanOf(builder);
  ASSERT_NE(early, nullptr);
  ASSERT_NE(early->cloud, nullptr);
  EXPECT_EQ(early->cloud->lines, early->lines);
  EXPECT_TRUE(early->scan->lines.empty());
}

TEST_F(EarlyScanTest, AThumbnailStandsForItsImageInFullSize) {
  Take({ChunkKind::kHeader, ChunkKind::kRig});
  Take({ChunkKind::kThumbnail});
  const auto early = EarlyScanOf(builder);
  ASSERT_NE(early, nullptr);
  ASSERT_EQ(early->scan->frames.size(), scan.frames.size());
  EXPECT_EQ(early->scan->frames.front().image.width(), scan.frames.front().image.width());
  EXPECT_EQ(early->scan->frames.front().seq, scan.frames.front().seq);
}

}  // namespace
}  // namespace foresight
