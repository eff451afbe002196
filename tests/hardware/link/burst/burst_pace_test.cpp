#include "hardware/link/burst/burst_pace.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

TEST(BurstPace, KeepsTheRate) {
  BurstPace pace(1000.0, 50.0);
  double now_s = 5.0;
  for (int i = 0; i < 1000; ++i) now_s += pace.Take(10.0, now_s);
  // 10,000 bytes, of which the first 50 go at once.
  EXPECT_NEAR(now_s - 5.0, 9.95, 1e-6) << "rounding of sums";
}

TEST(BurstPace, MakesGoodAShortDelayButNoLongOne) {
  BurstPace pace(1000.0, 50.0);
  double now_s = 0.0;
  now_s += pace.Take(50.0, now_s);
  EXPECT_EQ(now_s, 0.0);
  now_s = 10.0;  // nothing was sent for a long time
  EXPECT_EQ(pace.Take(50.0, now_s), 0.0);
  EXPECT_NEAR(pace.Take(50.0, now_s), 0.05, 1e-9);
}

TEST(ReturnPace, LeavesThreeQuartersOfAThinPathToOthers) {
  ReturnPace pace;
  double now_s = 0.0;
  double bytes = 0.0;
  for (; now_s < 100.0; now_s += 0.01) {
    if (!pace.MaySend(now_s)) continue;
    pace.Sent(30.0, now_s);
    bytes += 30.0 + ReturnPace::kAroundBytes;
  }
  EXPECT_LE(bytes, 100.0 * 1200.0 / 4.0 + 130.0) << "the first goes at once";
  EXPECT_GT(bytes, 90.0 * 1200.0 / 4.0) << "waits only as long as it must: to 0.01 s";
}

}  // namespace
}  // namespace foresight
