#include "core/depth/lidar_coverage.h"

#include <gtest/gtest.h>

#include "core/depth/tgv.h"
#include "core/depth/upsample.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

constexpr int kCoverWidth = 120;
constexpr int kCoverHeight = 60;

/// Samples every 4 px along and 8 px between the lines, in the left half of the image only.
AlignedSamples LeftHalf() {
  AlignedSamples samples =
      SamplesOnLattice(kCoverWidth, kCoverHeight, 4, 8, [](int, int) { return 2.0; });
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.samples[i].u > kCoverWidth / 2) samples.reasons[i] = RejectReason::kFlying;
  return samples;
}

TEST(LidarCoverage, EndsTwoSpacingsBesideTheLastSampleThatWasKept) {
  const FloatImage coverage = LidarCoverage(LeftHalf());
  EXPECT_EQ(coverage(30, 30), 1.0f);
  EXPECT_EQ(coverage(60 + 12, 30), 1.0f);
  EXPECT_EQ(coverage(60 + 24, 30), 0.0f);
}

TEST(LidarCoverage, IsTheMaskOfAMethodThatKnowsNoConfidence) {
  TgvOptions quick;
  quick.iterations = 5;
  const auto dense =
      UpsampleTgv(LeftHalf(), ColorImage(kCoverWidth, kCoverHeight, {128, 128, 128}), quick, {});
  ASSERT_TRUE(dense) << dense.error().message;
  EXPECT_FALSE(dense->has_confidence);
  EXPECT_FALSE(std::isnan(dense->depth_m(110, 30))) << "the method fills every pixel";
  const auto mask = MaskLowConfidence(*dense, {});
  ASSERT_TRUE(mask);
  EXPECT_EQ((*mask)(30, 30), 255);
  EXPECT_EQ((*mask)(110, 30), 0) << "no line passed there";
}

}  // namespace
}  // namespace foresight
