#include "hardware/link/chunks/line_blocks.h"

#include <gtest/gtest.h>

#include <limits>

#include "hardware/link/chunks/item_bytes.h"
#include "tests/hardware/link/chunks/random_scans.h"

namespace foresight {
namespace {

using samples::RandomLine;

std::vector<const LidarLine*> Pointers(const std::vector<LidarLine>& lines) {
  std::vector<const LidarLine*> pointers;
  for (const LidarLine& line : lines) pointers.push_back(&line);
  return pointers;
}

std::vector<LidarLine> RoundTrip(const std::vector<LidarLine>& lines) {
  auto back = DecodeRanges(EncodeRanges(Pointers(lines)).value()).value();
  auto intensities = DecodeIntensities(EncodeIntensities(Pointers(lines)).value()).value();
  EXPECT_EQ(intensities.size(), back.size());
  for (std::size_t i = 0; i < back.size(); ++i) back[i].intensity = intensities.at(i);
  return back;
}

TEST(LineBlocks, RandomLinesSurviveBitForBit) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    std::vector<LidarLine> lines;
    const int beams = random.Index(300);
    for (int i = 0; i < 1 + random.Index(kLinesPerBlock); ++i) {
      const int here = random.Index(5) == 0 ? random.Index(300) : beams;
      lines.push_back(RandomLine(random, here, random.Index(4) != 0));
      lines.back().seq = i * (1 + random.Index(50));
      lines.back().time_s = 0.025 * i + 1e-3 * random.Normal();
    }
    ASSERT_EQ(RoundTrip(lines), lines) << seed;
  }
}

TEST(LineBlocks, AnyValuesSurvive) {
  Random random(1);
  std::vector<LidarLine> lines(kLinesPerBlock);
  for (LidarLine& line : lines)
    for (int beam = 0; beam < 500; ++beam) {
      line.range_mm.push_back(static_cast<std::uint16_t>(random.Index(65536)));
      line.intensity.push_back(random.Index(2) == 0 ? 0 : 65535);
    }
  EXPECT_EQ(RoundTrip(lines), lines);
}

TEST(LineBlocks, SeqAndTimeSurviveAtTheirExtremes) {
  std::vector<LidarLine> lines(4);
  lines[0].seq = std::numeric_limits<std::int64_t>::min();
  lines[1].seq = std::numeric_limits<std::int64_t>::max();
  lines[2].seq = -1;
  lines[0].time_s = -std::numeric_limits<double>::max();
  lines[1].time_s = std::numeric_limits<double>::denorm_min();
  lines[2].time_s = -0.0;
  lines[3].time_s = std::numeric_limits<double>::max();
  const auto back = RoundTrip(lines);
  EXPECT_EQ(back, lines);
  EXPECT_TRUE(std::signbit(back[2].time_s));
}

TEST(LineBlocks, AFlatWallTakesAFewBytesALine) {
  LidarLine line;
  line.range_mm.assign(1081, 4000);
  line.intensity.assign(1081, 1000);
  std::vector<LidarLine> lines(kLinesPerBlock, line);
  for (int i = 0; i < kLinesPerBlock; ++i) lines[static_cast<std::size_t>(i)].seq = i;
  EXPECT_LT(EncodeRanges(Pointers(lines)).value().size(), 100U);
  EXPECT_LT(EncodeIntensities(Pointers(lines)).value().size(), 100U);
}

TEST(LineBlocks, TooManyLinesOrBeamsAreRefused) {
  const std::vector<LidarLine> many(kLinesPerBlock + 1);
  EXPECT_EQ(EncodeRanges(Pointers(many)).error().code, ErrorCode::kInvalidInput);
  std::vector<LidarLine> wide(1);
  wide[0].range_mm.resize(kMostBeamsOfALine + 1);
  EXPECT_EQ(EncodeRanges(Pointers(wide)).error().code, ErrorCode::kInvalidInput);
}

TEST(LineBlocks, ABlockThatClaimsABillionBeamsTakesNoMemory) {
  const std::string claim =
      ItemWriter().U8(1).U8(8).U8(1).Varint(1'000'000'000).Raw(std::string(64, '\0')).Take();
  EXPECT_EQ(DecodeRanges(claim).error().code, ErrorCode::kBadData);
  EXPECT_EQ(DecodeIntensities(claim).error().code, ErrorCode::kBadData);
}

TEST(LineBlocks, ABombOfZerosIsNoLongerThanItsBlock) {
  // 800,000 values of a block that claims 8 lines of 10 beams.
  const std::string bomb = ItemWriter()
                               .U8(1)
                               .U8(8)
                               .U8(1)
                               .Varint(10)
                               .U8(0)
                               .Packed(std::string(800'000, '\0'))
                               .Packed(std::string(800'000, '\0'))
                               .Take();
  EXPECT_EQ(DecodeIntensities(bomb).error().code, ErrorCode::kBadData);
}

TEST(LineBlocks, DamagedBlocksAreRefusedOrReadAsLines) {
  Random random(5);
  std::vector<LidarLine> lines(kLinesPerBlock, RandomLine(random, 200, true));
  const std::string good = EncodeRanges(Pointers(lines)).value();
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bad = good;
    const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(bad.size())));
    if (trial % 2 == 0)
      bad[at] = static_cast<char>(bad[at] ^ 1 << random.Index(8));
    else
      bad.resize(at);
    const auto read = DecodeRanges(bad);
    EXPECT_TRUE(!read || read->size() <= std::size_t{kLinesPerBlock});
    EXPECT_TRUE(!read || bad.size() == good.size()) << "it was cut";
  }
}

}  // namespace
}  // namespace foresight
