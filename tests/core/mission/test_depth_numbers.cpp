#include <gtest/gtest.h>

#include <cmath>

#include "core/mission/depth_numbers.h"

namespace foresight {
namespace {

/// 10 x 10 pixels at 0.01 to 1.00 m.
DenseDepth Ramp() {
  DenseDepth dense;
  dense.depth_m = DepthImage(10, 10);
  dense.confidence = FloatImage(10, 10, 0.5F);
  for (std::size_t i = 0; i < 100; ++i)
    dense.depth_m.values()[i] = 0.01F * static_cast<float>(i + 1);
  dense.max_confidence = 0.5F;
  return dense;
}

TEST(DepthNumbers, CountPixelsAndKeepTheQuantilesOfTheirDepth) {
  DenseDepth dense = Ramp();
  MaskImage mask(10, 10, 255);
  mask(0, 0) = mask(1, 0) = mask(9, 9) = 0;
  dense.depth_m(9, 9) = std::nanf("");  // hidden, but it has no depth anyway
  const DepthStatistics statistics = StatisticsOf(dense, mask);
  EXPECT_EQ(statistics.valid_pixels, 99);
  EXPECT_EQ(statistics.masked_pixels, 2);
  EXPECT_NEAR(statistics.depth_quantiles_m[0], 0.06, 1e-6);
  EXPECT_NEAR(statistics.depth_quantiles_m[2], 0.50, 1e-6);
  EXPECT_NEAR(statistics.depth_quantiles_m[4], 0.94, 1e-6);
  EXPECT_EQ(statistics.largest_confidence, 0.5);
}

TEST(DepthNumbers, OfAnEmptyMapHaveNoQuantiles) {
  DenseDepth dense = Ramp();
  for (float& depth : dense.depth_m.values()) depth = std::nanf("");
  const DepthStatistics statistics = StatisticsOf(dense, MaskImage(10, 10));
  EXPECT_EQ(statistics.valid_pixels, 0);
  EXPECT_TRUE(std::isnan(statistics.depth_quantiles_m[2]));
}

TEST(DepthNumbers, ADigestSeesEveryBitOfDepthConfidenceAndMask) {
  const DenseDepth dense = Ramp();
  const MaskImage mask(10, 10, 255);
  const std::string digest = DigestOf(dense, mask);
  EXPECT_EQ(DigestOf(Ramp(), mask), digest);
  DenseDepth other = dense;
  other.depth_m(3, 3) = std::nextafter(other.depth_m(3, 3), 9.0F);
  EXPECT_NE(DigestOf(other, mask), digest);
  other = dense;
  other.confidence(3, 3) = std::nextafter(other.confidence(3, 3), 9.0F);
  EXPECT_NE(DigestOf(other, mask), digest);
  MaskImage hidden = mask;
  hidden(9, 9) = 0;
  EXPECT_NE(DigestOf(dense, hidden), digest);
}

TEST(DepthNumbers, ADigestDoesNotSeeTheSignOfANan) {
  DenseDepth one = Ramp();
  DenseDepth other = Ramp();
  one.depth_m(0, 0) = std::nanf("");
  other.depth_m(0, 0) = -std::nanf("7");
  EXPECT_EQ(DigestOf(one, MaskImage(10, 10)), DigestOf(other, MaskImage(10, 10)));
}

}  // namespace
}  // namespace foresight
