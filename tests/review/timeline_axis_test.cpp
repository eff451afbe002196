#include "ui/viewmodels/timeline_axis.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kBegin = 1'700'000'000 * kSecond;

struct TimelineAxisTest : testing::Test {
  TimelineAxis axis;
  TimelineAxisTest() {
    axis.SetWidth(1000.0);
    axis.SetLimits(kBegin, kBegin + 100 * kSecond);
  }
};

TEST_F(TimelineAxisTest, AllIsInSightAtFirstWithALittleRoomBesideIt) {
  EXPECT_TRUE(axis.ShowsAll());
  EXPECT_NEAR(axis.XOf(kBegin), 19.2, 0.1);
  EXPECT_NEAR(axis.XOf(kBegin + 100 * kSecond), 980.8, 0.1);
}

TEST_F(TimelineAxisTest, ATimeAndItsPlaceAreEachOthersInverse) {
  axis.ZoomAt(300.0, 7.0);
  for (const double x : {0.0, 12.5, 500.0, 999.0}) EXPECT_NEAR(axis.XOf(axis.TimeAt(x)), x, 1e-3);
}

TEST_F(TimelineAxisTest, ZoomingKeepsTheTimeUnderTheMouse) {
  const std::int64_t under = axis.TimeAt(400.0);
  axis.ZoomAt(400.0, 4.0);
  EXPECT_NEAR(axis.XOf(under), 400.0, 0.01);
  EXPECT_NEAR(static_cast<double>(axis.End() - axis.Begin()), 26e9, 1e6);
}

TEST_F(TimelineAxisTest, NothingBeyondTheLimitsComesIntoSight) {
  const std::int64_t first = axis.Begin(), last = axis.End();
  axis.ZoomAt(500.0, 0.01);
  EXPECT_TRUE(axis.ShowsAll());
  axis.ZoomAt(500.0, 10.0);
  axis.PanBy(-1e7);
  EXPECT_EQ(axis.Begin(), first);
  axis.PanBy(1e7);
  EXPECT_EQ(axis.End(), last);
}

TEST_F(TimelineAxisTest, TheClosestLookIsTwentyMilliseconds) {
  axis.ZoomAt(500.0, 1e12);
  EXPECT_EQ(axis.End() - axis.Begin(), TimelineAxis::kShortest_ns);
}

TEST_F(TimelineAxisTest, WhatIsInSightStaysWhenTheMissionGrows) {
  axis.ZoomAt(500.0, 10.0);
  const std::int64_t begin = axis.Begin(), end = axis.End();
  axis.Extend(kBegin, kBegin + 1000 * kSecond);
  EXPECT_EQ(axis.Begin(), begin);
  EXPECT_EQ(axis.End(), end);
}

TEST_F(TimelineAxisTest, TicksStandAtRoundTimesAndFarEnoughApart) {
  for (const double factor : {1.0, 3.0, 50.0, 700.0}) {
    axis.ShowAll();
    axis.ZoomAt(500.0, factor);
    const auto ticks = axis.Ticks(90.0);
    ASSERT_FALSE(ticks.empty());
    for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_GE(ticks[i].x - ticks[i - 1].x, 90.0);
  }
  axis.ShowAll();
  EXPECT_TRUE(axis.Ticks(90.0)[0].text.endsWith(QStringLiteral("0")));
}

}  // namespace
}  // namespace foresight
