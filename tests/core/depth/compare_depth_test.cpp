#include "core/depth/compare_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace foresight {
namespace {

struct Maps {
  DepthImage first{20, 10, 2.0f};
  DepthImage second{20, 10, 2.0f};
  MaskImage first_mask{20, 10, 255};
  MaskImage second_mask{20, 10, 255};

  DepthComparison Compared() const { return CompareDepth(first, first_mask, second, second_mask); }
};

TEST(CompareDepth, EqualMapsDifferInNothing) {
  const DepthComparison same = Maps().Compared();
  EXPECT_EQ(same.in_both, 200);
  EXPECT_EQ(same.only_in_first + same.only_in_second + same.in_neither, 0);
  EXPECT_EQ(same.max_abs_m, 0.0);
  EXPECT_EQ(same.mean_m, 0.0);
}

TEST(CompareDepth, DifferencesAreSecondMinusFirstWithTheirQuantiles) {
  Maps maps;
  for (std::size_t i = 0; i < 200; ++i)
    maps.second.values()[i] = 2.0f + 0.0001f * static_cast<float>(i) - 0.01f;
  const DepthComparison compared = maps.Compared();
  EXPECT_NEAR(compared.difference_m(0, 0), -0.01, 1e-6);
  EXPECT_NEAR(compared.difference_m(19, 9), 0.0099, 1e-6);
  EXPECT_NEAR(compared.mean_m, -0.00005, 1e-6);
  EXPECT_NEAR(compared.median_abs_m, 0.005, 1e-4);  // |difference| is even from 0 to 10 mm
  EXPECT_NEAR(compared.p95_abs_m, 0.0095, 1e-4);
  EXPECT_NEAR(compared.max_abs_m, 0.01, 1e-6);
}

TEST(CompareDepth, MasksAndHolesAreCountedForTheMapThatHasThem) {
  Maps maps;
  maps.first_mask(0, 0) = 0;                             // only in the second
  maps.second(1, 0) = std::nanf("");                     // only in the first
  maps.second_mask(2, 0) = 0;                            // only in the first
  maps.first(3, 0) = maps.second(3, 0) = std::nanf("");  // in neither
  const DepthComparison compared = maps.Compared();
  EXPECT_EQ(compared.only_in_second, 1);
  EXPECT_EQ(compared.only_in_first, 2);
  EXPECT_EQ(compared.in_neither, 1);
  EXPECT_EQ(compared.in_both, 196);
  for (int x = 0; x < 4; ++x) EXPECT_TRUE(std::isnan(compared.difference_m(x, 0))) << x;
}

TEST(CompareDepth, EveryPixelOfBothIsInTheHistogramOrBeyondOneOfItsEnds) {
  Maps maps;
  maps.second(0, 0) = 2.0f + 0.5f;
  maps.second(1, 0) = 2.0f - 0.5f;
  maps.second(2, 0) = 2.0f + 0.0105f;
  const DepthComparison compared = maps.Compared();
  EXPECT_EQ(compared.above_histogram, 1);
  EXPECT_EQ(compared.below_histogram, 1);
  EXPECT_EQ(compared.histogram[40], 1);    // 10 to 11 mm
  EXPECT_EQ(compared.histogram[30], 197);  // 0 to 1 mm
  EXPECT_EQ(std::accumulate(compared.histogram.begin(), compared.histogram.end(), std::int64_t{2}),
            compared.in_both);
}

TEST(CompareDepth, WithoutACommonPixelThereIsNoNumber) {
  Maps maps;
  for (auto& value : maps.second_mask.values()) value = 0;
  const DepthComparison compared = maps.Compared();
  EXPECT_EQ(compared.in_both, 0);
  EXPECT_TRUE(std::isnan(compared.median_abs_m));
  EXPECT_TRUE(std::isnan(compared.mean_m));
}

}  // namespace
}  // namespace foresight
