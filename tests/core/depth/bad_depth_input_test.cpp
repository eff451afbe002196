// Whatever the samples are, every method gives a defined depth map or one clear error.
#include <gtest/gtest.h>

#include <limits>

#include "core/depth/depth_method.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

/// One sample, its point on the ray of a pinhole with f = 500 px.
AlignedSample SampleAt(float u, float v, float depth_m, int line, int beam) {
  return {u, v, depth_m, line, beam, {u * depth_m / 500.0f, v * depth_m / 500.0f, depth_m}};
}

AlignedSamples Of(int width, int height, std::vector<AlignedSample> list) {
  AlignedSamples samples;
  samples.width = width;
  samples.height = height;
  for (const AlignedSample& s : list) {
    samples.lines = std::max(samples.lines, s.line + 1);
    samples.beams = std::max(samples.beams, s.beam + 1);
  }
  samples.reasons.assign(list.size(), RejectReason::kKept);
  samples.samples = std::move(list);
  return samples;
}

ColorImage Checkerboard(int width, int height) {
  ColorImage guide(width, height, {60, 60, 60});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if ((x / 8 + y / 8) % 2 == 0) guide(x, y) = {180, 160, 140};
  return guide;
}

class BadDepthInput : public testing::TestWithParam<DepthMethod> {
 protected:
  Result<DepthResult> Run(const AlignedSamples& samples, const ColorImage& guide) {
    DepthOptions options = DefaultsOf(GetParam());
    // Enough for a look at what comes out.
    options.tgv.iterations = 50;
    options.nonlocal.iterations = 30;
    return ComputeDepth(samples, guide, options, {});
  }
  Result<DepthResult> Run(const AlignedSamples& samples) {
    return Run(samples, Checkerboard(samples.width, samples.height));
  }

  static void ExpectDefined(const Result<DepthResult>& result) {
    ASSERT_TRUE(result) << result.error().message;
    for (std::size_t i = 0; i < result->dense.depth_m.size(); ++i) {
      const float depth_m = result->dense.depth_m.values()[i];
      ASSERT_FALSE(std::isinf(depth_m)) << i;
      ASSERT_TRUE(std::isfinite(result->dense.confidence.values()[i])) << i;
      if (std::isnan(depth_m)) {
        ASSERT_EQ(result->mask.values()[i], 0) << i;
      }
    }
  }
  /// Depths between those of the samples, up to a fraction of overshoot.
  static void ExpectBetween(const Result<DepthResult>& result, float near_m, float far_m) {
    ExpectDefined(result);
    for (const float depth_m : result->dense.depth_m.values())
      if (!std::isnan(depth_m)) {
        ASSERT_GT(depth_m, near_m);
        ASSERT_LT(depth_m, far_m);
      }
  }
  static void ExpectError(const Result<DepthResult>& result, ErrorCode code, const char* what) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code) << result.error().message;
    EXPECT_NE(result.error().message.find(what), std::string::npos) << result.error().message;
  }
  /// A depth map like the samples, or a word that they are too few.
  static void ExpectBetweenOrTooFew(const Result<DepthResult>& result, float near_m, float far_m) {
    if (result)
      ExpectBetween(result, near_m, far_m);
    else
      ExpectError(result, ErrorCode::kTooFewPoints, "samples");
  }
};

TEST_P(BadDepthInput, NoSamplesAreTooFew) {
  ExpectError(Run(Of(40, 30, {})), ErrorCode::kTooFewPoints, "0 samples");
}

TEST_P(BadDepthInput, OneSample) {
  ExpectBetweenOrTooFew(Run(Of(40, 30, {SampleAt(20, 15, 1.0f, 0, 0)})), 0.99f, 1.01f);
}

TEST_P(BadDepthInput, TwoSamplesWithTheSameDepth) {
  ExpectBetweenOrTooFew(
      Run(Of(40, 30, {SampleAt(20, 15, 1.0f, 0, 0), SampleAt(24, 15, 1.0f, 0, 1)})), 0.99f, 1.01f);
}

TEST_P(BadDepthInput, AllSamplesInOnePixel) {
  std::vector<AlignedSample> list;
  for (int i = 0; i < 100; ++i) list.push_back(SampleAt(20, 15, 1.0f, i / 10, i % 10));
  ExpectBetweenOrTooFew(Run(Of(40, 30, list)), 0.99f, 1.01f);
}

TEST_P(BadDepthInput, AllSamplesNanZeroOrNegativeNameTheFirstOne) {
  for (const float depth_m : {std::numeric_limits<float>::quiet_NaN(), 0.0f, -1.0f,
                              std::numeric_limits<float>::infinity()}) {
    std::vector<AlignedSample> list;
    for (int i = 0; i < 9; ++i)
      list.push_back(SampleAt(4.0f * static_cast<float>(i), 5, depth_m, i / 3, i % 3));
    ExpectError(Run(Of(40, 30, list)), ErrorCode::kInvalidInput, "sample 0");
  }
}

TEST_P(BadDepthInput, AnImageOfAnotherSizeNamesBoth) {
  const auto samples = SamplesOnLattice(40, 30, 4, 6, [](int, int) { return 1.0; });
  const auto result = Run(samples, ColorImage(41, 30));
  ExpectError(result, ErrorCode::kInvalidInput, "41 x 30");
  EXPECT_NE(result.error().message.find("40 x 30"), std::string::npos);
}

TEST_P(BadDepthInput, AnEmptyImageHasNoSamples) {
  EXPECT_FALSE(Run(Of(0, 0, {})));
  EXPECT_FALSE(Run(Of(0, 5, {})));
}

TEST_P(BadDepthInput, BelowTheDensityFloorItWorksAndSaysSo) {
  const auto sparse = Run(SamplesOnLattice(160, 120, 10, 10, [](int, int) { return 1.0; }));
  ExpectBetween(sparse, 0.99f, 1.01f);
  EXPECT_NEAR(sparse->density, 0.01, 0.002);
  EXPECT_TRUE(sparse->BelowDensityFloor());
  const auto dense = Run(SamplesOnLattice(160, 120, 4, 12, [](int, int) { return 1.0; }));
  EXPECT_FALSE(dense->BelowDensityFloor());
}

TEST_P(BadDepthInput, DepthsThatNoLidarMeasuresAreRefusedByName) {
  for (const float depth_m : {1e-4f, 1e-38f, 2e4f, 1e30f, 3e38f}) {
    SCOPED_TRACE(depth_m);
    auto samples = SamplesOnLattice(40, 30, 4, 6, [](int, int) { return 1.0; });
    samples.samples[3].depth_m = depth_m;
    ExpectError(Run(samples), ErrorCode::kInvalidInput, "sample 3");
  }
}

TEST_P(BadDepthInput, TheNearestAndFarthestDepthsAllowedGiveDefinedDepths) {
  for (const double far_m : {0.001, 1.0, 1e4})
    ExpectDefined(
        Run(SamplesOnLattice(60, 40, 4, 6, [&](int u, int) { return u < 30 ? 0.001 : far_m; })));
}

TEST_P(BadDepthInput, SmallImages) {
  for (const int width : {1, 2, 3, 7})
    for (const int height : {1, 2, 5}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height);
      ExpectBetweenOrTooFew(
          Run(SamplesOnLattice(width, height, 1, 1, [](int, int) { return 1.5; })), 1.49f, 1.51f);
    }
}

TEST_P(BadDepthInput, AllSamplesInAColumnOrARow) {
  ExpectBetweenOrTooFew(
      Run(SamplesOnLattice(60, 40, 100, 2, [](int, int v) { return 1.0 + 0.001 * v; })), 0.9f,
      1.2f);
  ExpectBetweenOrTooFew(
      Run(SamplesOnLattice(60, 40, 2, 100, [](int u, int) { return 1.0 + 0.001 * u; })), 0.9f,
      1.2f);
}

TEST_P(BadDepthInput, SamplesOnTheBorder) {
  // From edge to edge of the outermost pixels; u < width - 0.5, v < height - 0.5.
  std::vector<AlignedSample> list;
  for (int line = 0; line < 5; ++line)
    for (int beam = 0; beam < 5; ++beam)
      list.push_back(SampleAt(std::nextafter(-0.5f + 10.0f * static_cast<float>(beam), 0.0f),
                              std::nextafter(-0.5f + 7.5f * static_cast<float>(line), 0.0f), 0.3f,
                              line, beam));
  ExpectBetween(Run(Of(40, 30, list)), 0.29f, 0.31f);
  ExpectError(Run(Of(40, 30, {SampleAt(39.5f, 0, 1.0f, 0, 0)})), ErrorCode::kInvalidInput,
              "outside the image");
}

TEST_P(BadDepthInput, APlaceOfTheGridThatDoesNotExistIsNamed) {
  AlignedSamples samples = SamplesOnLattice(40, 30, 4, 6, [](int, int) { return 1.0; });
  samples.samples[5].line = samples.lines;
  ExpectError(Run(samples), ErrorCode::kInvalidInput, "sample 5");
}

INSTANTIATE_TEST_SUITE_P(, BadDepthInput,
                         testing::Values(DepthMethod::kForesight, DepthMethod::kPaper,
                                         DepthMethod::kJointBilateral, DepthMethod::kTgv,
                                         DepthMethod::kNonlocal),
                         [](const auto& method) { return std::string(InfoOf(method.param).name); });

}  // namespace
}  // namespace foresight
