#include "core/depth/upsample.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

ColorImage GuideWithOneEdge(int width, int height, int edge_x) {
  ColorImage guide(width, height, {200, 200, 200});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < edge_x; ++x) guide(x, y) = {60, 60, 60};
  return guide;
}

UpsampleOptions SmallWindow() {
  UpsampleOptions options;
  options.sigma_spatial_px = 8.0;
  return options;
}

TEST(UpsampleDepth, DoesNotBlurAcrossAnEdgeOfTheGuide) {
  const ColorImage guide = GuideWithOneEdge(120, 60, 61);
  const AlignedSamples samples =
      SamplesOnLattice(120, 60, 4, 6, [](int u, int) { return u < 61 ? 1.0 : 2.0; });
  const auto dense = UpsampleDepth(samples, guide, SmallWindow(), {});
  ASSERT_TRUE(dense);
  EXPECT_NEAR(dense->depth_m(60, 30), 1.0, 1e-3);
  EXPECT_NEAR(dense->depth_m(61, 30), 2.0, 1e-3);
}

TEST(UpsampleDepth, AveragesNoiseOnAFlatWall) {
  Random random(4);
  const ColorImage guide(120, 60, {128, 128, 128});
  const AlignedSamples samples =
      SamplesOnLattice(120, 60, 4, 6, [&](int, int) { return 1.5 + 0.01 * random.Normal(); });
  const auto dense = UpsampleDepth(samples, guide, SmallWindow(), {});
  double squares = 0.0;
  for (int x = 20; x < 100; ++x) squares += std::pow(dense->depth_m(x, 30) - 1.5, 2.0);
  // About 8 samples of 10 mm in the window: 3.5 mm.
  EXPECT_LT(std::sqrt(squares / 80), 0.005);
}

TEST(UpsampleDepth, LeavesPixelsWithoutASampleInReachEmpty) {
  const ColorImage guide(120, 60, {128, 128, 128});
  const AlignedSamples samples =
      SamplesOnLattice(120, 60, 4, 6, [](int u, int) { return u < 40 ? 1.0 : NAN; });
  const auto dense = UpsampleDepth(samples, guide, SmallWindow(), {});
  EXPECT_TRUE(std::isnan(dense->depth_m(80, 30)));
  EXPECT_EQ(dense->confidence(80, 30), 0.0f);
}

TEST(UpsampleDepth, ConfidenceFallsWhereSamplesAreMissing) {
  const ColorImage guide(160, 60, {128, 128, 128});
  const AlignedSamples samples =
      SamplesOnLattice(160, 60, 4, 6, [](int u, int) { return u < 80 ? 1.0 : NAN; });
  const auto dense = UpsampleDepth(samples, guide, SmallWindow(), {});
  EXPECT_LT(dense->confidence(82, 30), 0.5f * dense->confidence(40, 30));
}

TEST(UpsampleDepth, TheIterationsConverge) {
  Random random(5);
  const ColorImage guide = GuideWithOneEdge(120, 60, 57);
  const AlignedSamples samples = SamplesOnLattice(
      120, 60, 4, 6, [&](int u, int) { return (u < 61 ? 1.0 : 1.2) + 0.01 * random.Normal(); });
  UpsampleOptions options = SmallWindow();
  options.keep_iterations = true;
  const auto dense = UpsampleDepth(samples, guide, options, {});
  ASSERT_EQ(dense->iterations.size(), 6u);
  ASSERT_EQ(dense->mean_change_m.size(), 5u);
  EXPECT_LT(dense->mean_change_m[4], 0.5 * dense->mean_change_m[0]);
  EXPECT_EQ(dense->iterations[5](60, 30), dense->depth_m(60, 30));
}

TEST(UpsampleDepth, LiteralWeightsMixSurfacesThatTheProductKeepsApart) {
  const ColorImage guide = GuideWithOneEdge(120, 60, 61);
  const AlignedSamples samples =
      SamplesOnLattice(120, 60, 4, 6, [](int u, int) { return u < 61 ? 1.0 : 2.0; });
  UpsampleOptions options = SmallWindow();
  options.weights = UpsampleOptions::Weights::kLiteral;
  const auto dense = UpsampleDepth(samples, guide, options, {});
  ASSERT_TRUE(dense);
  EXPECT_GT(dense->depth_m(60, 30), 1.05f);
}

TEST(UpsampleDepth, DoesNotDependOnTheNumberOfThreads) {
  const ColorImage guide = GuideWithOneEdge(120, 60, 61);
  const AlignedSamples samples =
      SamplesOnLattice(120, 60, 4, 6, [](int u, int v) { return 1.0 + 0.003 * u + 0.001 * v; });
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(UpsampleDepth(samples, guide, SmallWindow(), one)->depth_m,
            UpsampleDepth(samples, guide, SmallWindow(), four)->depth_m);
}

TEST(UpsampleDepth, RefusesAGuideOfAnotherSize) {
  const AlignedSamples samples = SamplesOnLattice(120, 60, 4, 6, [](int, int) { return 1.0; });
  const auto dense = UpsampleDepth(samples, ColorImage(119, 60), SmallWindow(), {});
  ASSERT_FALSE(dense);
  EXPECT_EQ(dense.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(dense.error().message.find("119 x 60"), std::string::npos);
}

TEST(UpsampleDepth, RefusesToInventFromNothing) {
  AlignedSamples samples = SamplesOnLattice(120, 60, 4, 6, [](int, int) { return 1.0; });
  std::fill(samples.reasons.begin(), samples.reasons.end(), RejectReason::kFlying);
  EXPECT_EQ(UpsampleDepth(samples, ColorImage(120, 60), SmallWindow(), {}).error().code,
            ErrorCode::kTooFewPoints);
}

TEST(ConfidenceMask, KeepsTheFractionOfTheLargestConfidence) {
  DenseDepth dense;
  dense.depth_m = DepthImage(4, 1, 1.0f);
  dense.confidence = FloatImage(4, 1);
  dense.confidence(0, 0) = 10.0f;
  dense.confidence(1, 0) = 3.5f;
  dense.confidence(2, 0) = 3.4f;
  dense.confidence(3, 0) = 9.0f;
  dense.depth_m(3, 0) = NAN;
  dense.max_confidence = 10.0f;
  const auto mask = MaskLowConfidence(dense, {});
  ASSERT_TRUE(mask);
  EXPECT_EQ((*mask)(0, 0), 255);
  EXPECT_EQ((*mask)(1, 0), 255);
  EXPECT_EQ((*mask)(2, 0), 0);
  EXPECT_EQ((*mask)(3, 0), 0);
  EXPECT_TRUE(std::isnan(ApplyMask(dense.depth_m, *mask)(2, 0)));
}

TEST(ConfidenceMask, AgainstTheNominalWeightOneDenseSpotDecidesNothing) {
  DenseDepth dense;
  dense.depth_m = DepthImage(3, 1, 1.0f);
  dense.confidence = FloatImage(3, 1);
  dense.confidence(0, 0) = 100.0f;
  dense.confidence(1, 0) = 9.0f;
  dense.confidence(2, 0) = 3.0f;
  dense.max_confidence = 100.0f;
  dense.nominal_confidence = 10.0f;
  EXPECT_EQ((*MaskLowConfidence(dense, {}))(1, 0), 0);
  ConfidenceMaskOptions options;
  options.reference = ConfidenceMaskOptions::Reference::kNominal;
  const MaskImage mask = *MaskLowConfidence(dense, options);
  EXPECT_EQ(mask(0, 0), 255);
  EXPECT_EQ(mask(1, 0), 255);
  EXPECT_EQ(mask(2, 0), 0);
}

TEST(NominalConfidence, IsTheIntegralOfTheGaussianOverTheDiscTimesTheDensityAndThePasses) {
  const ColorImage guide(240, 120, {128, 128, 128});
  const AlignedSamples samples = SamplesOnLattice(240, 120, 4, 12, [](int, int) { return 1.0; });
  UpsampleOptions options;
  options.sigma_spatial_px = 20.0;
  options.radius_in_sigmas = 1.5;
  const double disc = 2.0 * 3.14159265 * 400.0 * (1.0 - std::exp(-0.5 * 1.5 * 1.5)) / 48.0;
  // The disc is made of whole pixels: 1 %.
  EXPECT_NEAR(UpsampleDepth(samples, guide, options, {})->nominal_confidence, 6.0 * disc,
              0.06 * disc);
  options.confidence_passes = ConfidencePasses::kGuided;
  EXPECT_NEAR(UpsampleDepth(samples, guide, options, {})->nominal_confidence, 5.0 * disc,
              0.05 * disc);
}

TEST(NominalConfidence, IsWhatAFlatWallReachesInEveryReading) {
  using Weights = UpsampleOptions::Weights;
  const ColorImage guide(240, 120, {128, 128, 128});
  const AlignedSamples samples = SamplesOnLattice(240, 120, 4, 6, [](int, int) { return 1.0; });
  for (const Weights terms : {Weights::kProduct, Weights::kLiteral})
    for (const ConfidencePasses passes :
         {ConfidencePasses::kAll, ConfidencePasses::kEveryDepth, ConfidencePasses::kGuided}) {
      UpsampleOptions options;
      options.sigma_spatial_px = 20.0;
      options.confidence_terms = terms;
      options.confidence_passes = passes;
      const auto dense = UpsampleDepth(samples, guide, options, {});
      // The mean over one period of the lattice; a single pixel may see a row of samples more.
      double mean = 0.0;
      for (int y = 60; y < 66; ++y)
        for (int x = 120; x < 124; ++x) mean += static_cast<double>(dense->confidence(x, y)) / 24.0;
      EXPECT_NEAR(mean / dense->nominal_confidence, 1.0, 0.01);
    }
}

TEST(UpsampleDepth, RefusesAConfidenceOfPassesThatThereAreNot) {
  const AlignedSamples samples = SamplesOnLattice(120, 60, 4, 6, [](int, int) { return 1.0; });
  UpsampleOptions options = SmallWindow();
  options.iterations = 0;
  options.confidence_passes = ConfidencePasses::kGuided;
  const auto dense = UpsampleDepth(samples, ColorImage(120, 60), options, {});
  ASSERT_FALSE(dense);
  EXPECT_NE(dense.error().message.find("confidence_passes"), std::string::npos);
}

}  // namespace
}  // namespace foresight
