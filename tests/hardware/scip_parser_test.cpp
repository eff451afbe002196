#include "hardware/scip/scip_parser.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "hardware/scip/scip_codec.h"

namespace foresight {
namespace {

std::vector<ScipReply> Replies(ScipParser& parser) {
  std::vector<ScipReply> replies;
  while (auto reply = parser.Take()) replies.push_back(std::move(*reply));
  return replies;
}

std::string ScanBytes(std::uint32_t stamp_ms, int last_step = 100) {
  ScipScan scan;
  scan.request = {.command = ScipCommand::kStreamIntensity, .last_step = last_step, .tag = "s1"};
  scan.stamp_ms = stamp_ms;
  Random random(stamp_ms);
  for (int i = 0; i <= last_step; ++i)
    scan.steps.push_back({{ScipEcho{static_cast<std::uint32_t>(random.Index(60000)),
                                    static_cast<std::uint32_t>(random.Index(60000))}},
                          1});
  return EncodeScipScan(scan);
}

TEST(ScipParser, CutsAtTheEmptyLine) {
  ScipParser parser;
  parser.Push("QT;q\n00P\n\nTM0\n02R\n\nME0000108001000;s17\n00P\n\n");
  const auto replies = Replies(parser);
  ASSERT_EQ(replies.size(), 3u);
  EXPECT_EQ(replies[0], (ScipReply{"QT;q", "00", {}}));
  EXPECT_EQ(replies[1].status, "02");
  EXPECT_EQ(replies[2].echo, "ME0000108001000;s17");
  EXPECT_EQ(parser.damaged(), 0);
}

TEST(ScipParser, AnySplitOfTheBytesGivesTheSameReplies) {
  const std::string bytes = "QT\n00P\n\n" + ScanBytes(1) + ScanBytes(2) + "TM1\n00P\n0N90W\n\n";
  ScipParser whole;
  whole.Push(bytes);
  const auto expected = Replies(whole);
  ASSERT_EQ(expected.size(), 4u);
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    ScipParser parser;
    std::vector<ScipReply> replies;
    for (std::size_t at = 0; at < bytes.size();) {
      const auto size = static_cast<std::size_t>(1 + random.Index(trial + 1));
      parser.Push(std::string_view(bytes).substr(at, size));
      at += size;
      for (auto& reply : Replies(parser)) replies.push_back(std::move(reply));
    }
    ASSERT_EQ(replies, expected) << trial;
    ASSERT_FALSE(parser.InReply());
  }
}

TEST(ScipParser, AWrongStatusSumDropsTheReply) {
  ScipParser parser;
  parser.Push("QT\n00Q\n\nQT\n00P\n\n");
  EXPECT_EQ(Replies(parser).size(), 1u);
  EXPECT_EQ(parser.damaged(), 1);
}

TEST(ScipParser, ALostEmptyLineCostsOnlyTheScanBeforeIt) {
  std::string first = ScanBytes(1);
  first.erase(first.size() - 2);  // both line feeds
  ScipParser parser;
  parser.Push(first + "\n" + ScanBytes(2));
  const auto replies = Replies(parser);
  ASSERT_EQ(replies.size(), 1u);
  EXPECT_EQ(DecodeScipScan(replies[0]).value().stamp_ms, 2u);
}

TEST(ScipParser, TheNextCleanScanGetsThroughWhateverHappenedToTheOneBefore) {
  Random random(11);
  int recovered = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string damaged = ScanBytes(1);
    const auto at = static_cast<std::size_t>(random.Index(static_cast<int>(damaged.size())));
    const auto size = static_cast<std::size_t>(1 + random.Index(40));
    switch (trial % 3) {
      case 0:
        damaged[at] = static_cast<char>(random.Index(256));
        break;
      case 1:
        damaged.erase(at, size);
        break;
      default:
        damaged.insert(at, size, static_cast<char>(random.Index(256)));
    }
    ScipParser parser;
    parser.Push(damaged + ScanBytes(2) + ScanBytes(3));
    bool second = false;
    bool third = false;
    for (const ScipReply& reply : Replies(parser)) {
      const auto scan = DecodeScipScan(reply);
      second |= scan && scan->stamp_ms == 2;
      third |= scan && scan->stamp_ms == 3;
    }
    recovered += second;
    EXPECT_TRUE(third) << "trial " << trial;
  }
  // Damage that eats the last line feed glues the next echo to the last line of data.
  EXPECT_GE(recovered, kTrials * 97 / 100);
}

TEST(ScipParser, BytesWithoutAnEndDoNotFillTheMemory) {
  ScipParser parser;
  for (int i = 0; i < 100; ++i) parser.Push(std::string(10000, 'x'));
  EXPECT_GT(parser.damaged(), 10);
  parser.Push("\n\n" + ScanBytes(5));
  ASSERT_EQ(Replies(parser).size(), 1u);
}

TEST(ScipRequestReader, TakesLineFeedAndCarriageReturn) {
  ScipRequestReader reader;
  reader.Push("VV\r\nP");
  reader.Push("P\rQT;a\n\n");
  EXPECT_EQ(reader.Take(), "VV");
  EXPECT_EQ(reader.Take(), "PP");
  EXPECT_EQ(reader.Take(), "QT;a");
  EXPECT_FALSE(reader.Take());
}

}  // namespace
}  // namespace foresight
