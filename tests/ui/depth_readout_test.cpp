#include "ui/viewmodels/depth_readout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/depth/depth_method.h"

namespace foresight {
namespace {

/// 40 x 40 pixels at 2 m with the largest confidence 10 and a search radius of 21 px; one kept
/// sample in the middle.
struct ReadoutTest : testing::Test {
  DepthResult result;
  double threshold = 0.35;
  double radius_px = 21.0;

  ReadoutTest() {
    result.dense.depth_m = DepthImage(40, 40, 2.0f);
    result.dense.confidence = FloatImage(40, 40, 10.0f);
    result.dense.max_confidence = 10.0f;
    result.density = 0.1;
    AddSample(20.0f, 20.0f, RejectReason::kKept);
  }
  void AddSample(float u, float v, RejectReason reason) {
    AlignedSample sample;
    sample.u = u;
    sample.v = v;
    sample.depth_m = 2.0f;
    result.samples.samples.push_back(sample);
    result.samples.reasons.push_back(reason);
  }
  void Empty(int x, int y) { result.dense.depth_m(x, y) = std::nanf(""); }
  DepthReadout Read(int x, int y) const {
    return ReadDepth({result, result.dense.depth_m, threshold, radius_px}, x, y);
  }
};

TEST_F(ReadoutTest, AMethodWithoutAConfidenceSaysSoInPlaceOfANumber) {
  result.dense.has_confidence = false;
  result.dense.max_confidence = 1.0f;
  result.dense.confidence = FloatImage(40, 40, 1.0f);
  result.dense.confidence(3, 3) = 0.0f;
  EXPECT_EQ(TextOf(Read(20, 21)).toStdString(),
            "(20, 21)  2000 mm, this method knows no confidence");
  EXPECT_TRUE(TextOf(Read(3, 3)).contains("no lidar line passed here"));
}

TEST_F(ReadoutTest, ATrustedPixelHasDepthInMillimetresAndNoReason) {
  const DepthReadout readout = Read(20, 21);
  EXPECT_DOUBLE_EQ(readout.depth_mm, 2000.0);
  EXPECT_FALSE(readout.masked);
  EXPECT_TRUE(readout.reason.isEmpty());
  EXPECT_EQ(TextOf(readout).toStdString(), "(20, 21)  2000 mm, confidence 1.00 of the largest");
}

TEST_F(ReadoutTest, AMaskedPixelSaysHowFarItIsBelowTheThreshold) {
  result.dense.confidence(5, 20) = 2.1f;
  const DepthReadout readout = Read(5, 20);
  EXPECT_TRUE(readout.masked);
  EXPECT_EQ(TextOf(readout).toStdString(),
            "(5, 20)  2000 mm, confidence 0.21 of the largest  masked: below the threshold 0.35; "
            "the nearest sample is 15 px away");
}

TEST_F(ReadoutTest, WordsAndMaskAgreeExactlyAtTheThreshold) {
  result.dense.confidence(5, 20) = 3.5f;
  const auto mask = MaskLowConfidence(result.dense, {.threshold = threshold});
  EXPECT_EQ(Read(5, 20).masked, (*mask)(5, 20) == 0);
}

TEST_F(ReadoutTest, AMaskedPixelNamesTheRejectedSampleItLost) {
  result.dense.confidence(5, 20) = 2.1f;
  AddSample(7.0f, 20.0f, RejectReason::kFlying);
  EXPECT_TRUE(Read(5, 20).reason.contains("2 px away, was rejected as flying"))
      << Read(5, 20).reason.toStdString();
}

TEST_F(ReadoutTest, AnEmptyPixelOutOfReachSaysHowFarItLooked) {
  Empty(0, 0);
  EXPECT_EQ(TextOf(Read(0, 0)).toStdString(), "(0, 0)  empty: no lidar sample within 21 px");
}

TEST_F(ReadoutTest, AnEmptyPixelNamesTheRejectedSampleThatWouldHaveReachedIt) {
  Empty(0, 0);
  AddSample(0.0f, 4.0f, RejectReason::kFlipping);
  EXPECT_EQ(Read(0, 0).reason.toStdString(),
            "no kept lidar sample within 21 px; the nearest, 4 px away, was rejected as flipping");
}

TEST_F(ReadoutTest, AnEmptyPixelAmongKeptSamplesDoesNotClaimThereAreNone) {
  Empty(20, 18);
  EXPECT_EQ(Read(20, 18).reason.toStdString(), "the lidar samples within 21 px agree on no depth");
}

TEST_F(ReadoutTest, AMethodWithoutARadiusOnlySaysWhereTheNearestSampleIs) {
  radius_px = 0.0;
  Empty(20, 0);
  EXPECT_EQ(Read(20, 0).reason.toStdString(), "the nearest lidar sample is 20 px away");
}

TEST_F(ReadoutTest, AnAbsoluteConfidenceIsNotCalledAFractionOfTheLargest) {
  result.dense.confidence = FloatImage(40, 40, 0.9f);
  result.dense.max_confidence = 1.0f;
  EXPECT_EQ(TextOf(Read(20, 21)).toStdString(), "(20, 21)  2000 mm, confidence 0.90");
}

TEST_F(ReadoutTest, BelowTheDensityFloorNoPixelLooksTrusted) {
  result.density = 0.0199;
  EXPECT_EQ(TextOf(Read(20, 21)).toStdString(),
            "(20, 21)  2000 mm, confidence 1.00 of the largest  not to be trusted: too few samples "
            "in this map");
}

TEST_F(ReadoutTest, TheWarningNamesTheDensityAndTheFloorAndIsSilentAboveIt) {
  result.density = 0.0143;
  const std::string warning = DensityWarning(result).toStdString();
  EXPECT_NE(warning.find("1.43"), std::string::npos) << warning;
  EXPECT_NE(warning.find("floor of 2"), std::string::npos) << warning;
  result.density = 0.02;
  EXPECT_TRUE(DensityWarning(result).isEmpty());
}

/// A map made by this method with sigma_s = 7 px, where each method has a radius of its own.
double RadiusOf(DepthMethod method) {
  DepthResult result;
  result.dense.sigma_spatial_px = 7.0;
  DepthOptions options = DefaultsOf(method);
  options.upsample.radius_in_sigmas = 3.0;
  options.local_plane.radius_in_sigmas = 2.0;
  return SearchRadius(result, options);
}

TEST(SearchRadius, IsThatOfTheMethodsOwnWindow) {
  EXPECT_DOUBLE_EQ(RadiusOf(DepthMethod::kPaper), 21.0);
  EXPECT_DOUBLE_EQ(RadiusOf(DepthMethod::kJointBilateral), 21.0);
  EXPECT_DOUBLE_EQ(RadiusOf(DepthMethod::kForesight), 14.0);
}

TEST(SearchRadius, IsNotKnownOfMethodsThatFillEveryPixel) {
  EXPECT_DOUBLE_EQ(RadiusOf(DepthMethod::kTgv), 0.0);
  EXPECT_DOUBLE_EQ(RadiusOf(DepthMethod::kNonlocal), 0.0);
}

}  // namespace
}  // namespace foresight
