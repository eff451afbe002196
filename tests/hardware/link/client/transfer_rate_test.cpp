#include "hardware/link/client/transfer_rate.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

constexpr std::int64_t kMuch = 10'000'000;  ///< left at the head

TEST(TransferRate, AFastPathGetsMoreCreditWithinAWindowOfASecond) {
  TransferRate rate;
  rate.Begin(0.0);
  double now_s = 30.0;  // after a blackout
  for (int i = 0; i < 500; ++i) rate.Received(20'000, kMuch, now_s += 0.001);
  EXPECT_GE(rate.credit(), 500'000);
}

TEST(TransferRate, ABlackoutTakesNoCreditAway) {
  TransferRate rate;
  rate.Begin(0.0);
  double now_s = 0.0;
  for (int i = 0; i < 100; ++i) rate.Received(20'000, kMuch, now_s += 0.001);
  const std::int64_t before = rate.credit();
  for (int window = 0; window < 10; ++window) {
    rate.Begin(now_s);
    now_s += 25.0;
    for (int i = 0; i < 20; ++i) rate.Received(20'000, kMuch, now_s += 0.001);
  }
  EXPECT_GE(rate.credit(), before);
}

TEST(TransferRate, AThinPathHasLittleOnItsWay) {
  TransferRate rate;
  rate.Begin(0.0);
  double now_s = 0.0;
  for (int i = 0; i < 100; ++i) rate.Received(20'000, kMuch, now_s += 0.001);
  for (int i = 0; i < 2000; ++i) rate.Received(1'200, kMuch, now_s += 1.0);
  EXPECT_EQ(rate.credit(), TransferRate::kLeastCredit);
}

TEST(TransferRate, APathOfShortRoundTripsBeginsWithALargeCredit) {
  TransferRate rate;
  rate.Begin(0.0, true);
  EXPECT_EQ(rate.credit(), TransferRate::kWideCredit);
  // And gets more: a burst of a second is used up by one credit after the other.
  double now_s = 0.0;
  for (int i = 0; i < 20; ++i) rate.Received(TransferRate::kMostCredit, kMuch, now_s += 0.1);
  EXPECT_EQ(rate.credit(), TransferRate::kMostCredit);
  rate.Begin(now_s, true);
  EXPECT_EQ(rate.credit(), TransferRate::kMostCredit) << "what was learned stays";
}

TEST(TransferRate, AWindowThatOpensGetsItsCreditWithinAFewHundredths) {
  TransferRate rate;
  rate.Begin(0.0, true);
  double now_s = 2.0;
  const double end_s = now_s + 0.15;
  while (now_s < end_s) rate.Received(60'000, kMuch, now_s += 0.0016);  // 300 Mbit/s
  EXPECT_GE(rate.credit(), 8 * TransferRate::kWideCredit);
}

TEST(TransferRate, ThePathsRateIsKnownOnlyWhereThereWasMoreToSend) {
  TransferRate rate;
  rate.Begin(0.0);
  double now_s = 0.0;
  for (int i = 0; i < 50; ++i) rate.Received(2'000, 0, now_s += 0.1);
  EXPECT_FALSE(rate.PathBytesPerS(now_s)) << "a slow scan is no slow path";
  for (int i = 0; i < 50; ++i) rate.Received(2'000, kMuch, now_s += 0.1);
  EXPECT_NEAR(rate.PathBytesPerS(now_s).value(), 20'000.0, 2'000.0);
}

}  // namespace
}  // namespace foresight
