#include "hardware/link/client/silence_watch.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

constexpr double kPath_s = 0.01;  ///< there and back

TEST(SilenceWatch, DoubtsOnceASilence) {
  SilenceWatch watch;
  watch.Begin(9.0);
  watch.Heard(10.0);
  EXPECT_FALSE(watch.Doubts(10.3, kPath_s));
  EXPECT_TRUE(watch.Doubts(10.35, kPath_s));
  EXPECT_FALSE(watch.Doubts(10.4, kPath_s));
  EXPECT_TRUE(watch.Heard(10.5)) << "the doubt is over";
  EXPECT_FALSE(watch.Heard(10.6));
}

TEST(SilenceWatch, AHeadThatReadsALargeScanBeforeItsFirstWordCostsNoPatience) {
  SilenceWatch watch;
  watch.Begin(0.0);
  EXPECT_FALSE(watch.Doubts(2.3, kPath_s));
  EXPECT_TRUE(watch.Doubts(2.5, kPath_s)) << "it may be the connection after all";
  watch.Begin(2.55);
  watch.Heard(2.9);
  EXPECT_TRUE(watch.Doubts(3.25, kPath_s)) << "as quick as ever in the blackout that follows";
}

TEST(SilenceWatch, ALongRoundTripIsNoSilence) {
  SilenceWatch watch;
  watch.Begin(0.0);
  watch.Heard(0.0);
  EXPECT_FALSE(watch.Doubts(0.8, 0.6));
  EXPECT_TRUE(watch.Doubts(0.95, 0.6));
}

TEST(SilenceWatch, AHeadThatIsSlowIsNotLeftAgainAndAgain) {
  SilenceWatch watch;
  watch.Begin(0.0);
  watch.Heard(0.0);
  int doubts = 0;
  double now_s = 0.0;
  for (int image = 0; image < 20; ++image) {
    const double next_s = now_s + 0.5;  // to encode an image
    for (; now_s < next_s; now_s += 0.01) {
      if (!watch.Doubts(now_s, kPath_s)) continue;
      ++doubts;
      watch.Begin(now_s + 0.05);  // a fresh connection over a path that is open
    }
    watch.Heard(now_s);
  }
  EXPECT_EQ(doubts, 1);
}

TEST(SilenceWatch, AfterABlackoutItIsQuickAgain) {
  SilenceWatch watch;
  watch.Begin(0.0);
  watch.Heard(0.0);
  for (double begin_s = 0.0; begin_s < 20.0; begin_s += 2.0) {
    double doubted_s = 0.0;
    for (double now_s = begin_s; now_s < begin_s + 1.0 && doubted_s == 0.0; now_s += 0.01)
      if (watch.Doubts(now_s, kPath_s)) doubted_s = now_s;
    EXPECT_NEAR(doubted_s, begin_s + SilenceWatch::kShortest_s, 0.03);
    watch.Begin(begin_s + 1.03);  // the window
    watch.Heard(begin_s + 2.0);
  }
}

}  // namespace
}  // namespace foresight
