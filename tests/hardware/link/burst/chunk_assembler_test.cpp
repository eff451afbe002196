#include "hardware/link/burst/chunk_assembler.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.h"

namespace foresight {
namespace {

constexpr std::uint32_t kAssembledStride = 100;
constexpr std::uint64_t kTag = 77;

Chunk RandomChunk(Random& random, std::int64_t item, int bytes) {
  std::string text(static_cast<std::size_t>(bytes), '\0');
  for (char& byte : text) byte = static_cast<char>(random.Index(256));
  return SplitItem({ChunkKind::kImage, item}, text).value().front();
}

struct Piece {
  std::vector<std::uint8_t> content;
  ChunkFragment Fragment() const { return ReadFragment(content).value(); }
};

std::vector<Piece> PiecesOf(const Chunk& chunk, std::uint32_t stride = kAssembledStride) {
  std::vector<Piece> pieces(FragmentCount(chunk, stride));
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    WriteFragment(kTag, chunk, stride, i, pieces[i].content);
  return pieces;
}

TEST(ChunkFragment, SaysWhatItIsOf) {
  Random random(1);
  const Chunk chunk = RandomChunk(random, 16'777'215, 250);
  const auto pieces = PiecesOf(chunk);
  ASSERT_EQ(pieces.size(), 3u);
  const ChunkFragment last = pieces[2].Fragment();
  EXPECT_EQ(last.scan_tag, kTag);
  EXPECT_EQ(last.id, chunk.id);
  EXPECT_EQ(last.item_crc, chunk.item_crc);
  EXPECT_EQ(last.crc, chunk.crc);
  EXPECT_EQ(last.bytes.size(), 50u);
  EXPECT_EQ(pieces[0].content.size(), kFragmentHeadBytes + kAssembledStride);
}

TEST(ChunkFragment, CutOrLengthenedIsRefused) {
  Random random(1);
  const Piece good = PiecesOf(RandomChunk(random, 0, 250))[2];
  for (std::size_t size = 0; size < good.content.size(); ++size)
    EXPECT_FALSE(ReadFragment(std::span(good.content).first(size))) << size;
  Piece longer = good;
  longer.content.push_back(0);
  EXPECT_FALSE(ReadFragment(longer.content));
}

TEST(ChunkFragment, WithAWildNumberIsRefused) {
  Random random(1);
  const Piece good = PiecesOf(RandomChunk(random, 0, 250))[1];
  // kind, item, part, parts, size and stride, index
  for (const std::size_t at : {8u, 12u, 13u, 16u, 26u, 28u, 31u}) {
    Piece wild = good;
    wild.content[at] = 0xff;
    EXPECT_FALSE(ReadFragment(wild.content)) << "byte " << at;
  }
}

TEST(ChunkAssembler, MakesTheChunksOfLostShuffledAndRepeatedFragments) {
  Random random(7);
  std::vector<Chunk> chunks;
  std::vector<Piece> pieces;
  for (int i = 0; i < 60; ++i) {
    chunks.push_back(RandomChunk(random, i, random.Index(20) == 0 ? 0 : random.Index(6000)));
    const auto more = PiecesOf(chunks.back());
    pieces.insert(pieces.end(), more.begin(), more.end());
  }
  ChunkAssembler assembler;
  std::set<std::int64_t> whole;
  for (int round = 0; round < 30 && whole.size() < chunks.size(); ++round) {
    for (std::size_t i = pieces.size(); i > 1; --i)
      std::swap(pieces[i - 1], pieces[static_cast<std::size_t>(random.Index(static_cast<int>(i)))]);
    for (const Piece& piece : pieces) {
      if (random.Index(3) == 0) continue;
      const ChunkFragment fragment = piece.Fragment();
      if (whole.count(fragment.id.item) != 0) continue;
      const auto taken = assembler.Take(fragment);
      ASSERT_TRUE(taken) << taken.error().message;
      if (!*taken) continue;
      EXPECT_EQ(**taken, chunks[static_cast<std::size_t>((*taken)->id.item)]);
      whole.insert((*taken)->id.item);
    }
  }
  EXPECT_EQ(whole.size(), chunks.size());
  EXPECT_EQ(assembler.bytes(), 0u);
}

TEST(ChunkAssembler, ForgetsAChunkThatIsNotWhatItsCrcSays) {
  Random random(2);
  Chunk chunk = RandomChunk(random, 0, 150);
  chunk.bytes[3] = static_cast<char>(chunk.bytes[3] ^ 1);
  ChunkAssembler assembler;
  const auto pieces = PiecesOf(chunk);
  ASSERT_TRUE(assembler.Take(pieces[0].Fragment()));
  EXPECT_FALSE(assembler.Take(pieces[1].Fragment()));
  EXPECT_EQ(assembler.chunks(), 0u);
}

TEST(ChunkAssembler, BeginsAnewWhereTheChunkWasMadeAnew) {
  Random random(2);
  const Chunk old = RandomChunk(random, 0, 150), other = RandomChunk(random, 0, 150);
  ChunkAssembler assembler;
  ASSERT_TRUE(assembler.Take(PiecesOf(old)[0].Fragment()));
  ASSERT_TRUE(assembler.Take(PiecesOf(other)[1].Fragment()));
  const auto taken = assembler.Take(PiecesOf(other)[0].Fragment());
  ASSERT_TRUE(taken && *taken);
  EXPECT_EQ(**taken, other);
}

TEST(ChunkAssembler, StaysWithinItsMemory) {
  Random random(5);
  constexpr std::size_t kMost = 100'000;
  ChunkAssembler assembler(kMost);
  for (int i = 0; i < 500; ++i) {
    const Chunk chunk = RandomChunk(random, i, 200 + random.Index(8000));
    ASSERT_TRUE(assembler.Take(PiecesOf(chunk)[0].Fragment()));
    ASSERT_LE(assembler.bytes(), kMost);
  }
  EXPECT_GT(assembler.chunks(), 10u);
  // The newest one is still there.
  const Chunk chunk = RandomChunk(random, 1000, 150);
  ASSERT_TRUE(assembler.Take(PiecesOf(chunk)[1].Fragment()));
  EXPECT_TRUE(assembler.Take(PiecesOf(chunk)[0].Fragment()).value());
}

}  // namespace
}  // namespace foresight
