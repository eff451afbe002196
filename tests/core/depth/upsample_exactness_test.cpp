// The vector kernel against Eq. (8) and (9) in double precision, on every instruction set.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/depth/upsample.h"
#include "tests/support/on_every_vector_target.h"
#include "tests/support/sample_grids.h"
#include "tests/support/upsample_reference.h"

namespace foresight {
namespace {

struct Problem {
  AlignedSamples samples;
  ColorImage guide;
};

/// Noise in the guide, a step in the depth, samples off the pixel centres and some sharing a pixel.
Problem RandomProblem(int width, int height, int step_u, int step_v, double depth_m = 1.0) {
  Random random(3);
  Problem problem;
  problem.guide = ColorImage(width, height);
  for (auto& pixel : problem.guide.values()) {
    const auto value = static_cast<std::uint8_t>(random.Index(256));
    pixel = {value, value, value};
  }
  problem.samples = SamplesOnLattice(width, height, step_u, step_v, [&](int u, int v) {
    return depth_m + (u < width / 2 ? 0.0 : 0.4) + 0.002 * v + 0.01 * random.Normal();
  });
  for (AlignedSample& s : problem.samples.samples) {
    s.u = std::clamp(s.u + static_cast<float>(2.0 * random.Normal()), -0.49f,
                     static_cast<float>(width) - 0.51f);
    s.v = std::clamp(s.v + static_cast<float>(2.0 * random.Normal()), -0.49f,
                     static_cast<float>(height) - 0.51f);
  }
  return problem;
}

UpsampleOptions DepthWindow(double sigma_px, double radius_in_sigmas = 1.0) {
  UpsampleOptions options;
  options.sigma_spatial_px = sigma_px;
  options.radius_in_sigmas = radius_in_sigmas;
  return options;
}

/// Single against double precision: 0.02 mm. A pixel between two surfaces makes more of a rounding
/// error with each pass: 1e-4 of the largest confidence.
void ExpectByTheBook(const Problem& problem, const UpsampleOptions& options) {
  const auto fast = UpsampleDepth(problem.samples, problem.guide, options, {});
  ASSERT_TRUE(fast) << fast.error().message;
  const DenseDepth plain = UpsampleByTheBook(problem.samples, problem.guide, options);
  ASSERT_GT(plain.max_confidence, 0.0f);
  for (int y = 0; y < problem.guide.height(); ++y)
    for (int x = 0; x < problem.guide.width(); ++x) {
      ASSERT_EQ(std::isnan(fast->depth_m(x, y)), std::isnan(plain.depth_m(x, y))) << x << ", " << y;
      if (std::isnan(plain.depth_m(x, y))) continue;
      ASSERT_NEAR(fast->depth_m(x, y), plain.depth_m(x, y), 2e-5) << x << ", " << y;
      ASSERT_NEAR(fast->confidence(x, y), plain.confidence(x, y), 1e-4 * plain.max_confidence)
          << x << ", " << y;
    }
}

class UpsampleExactness : public OnEveryVectorTarget {};

TEST_P(UpsampleExactness, IsEquationEight) {
  ExpectByTheBook(RandomProblem(64, 48, 4, 6), DepthWindow(8.0));
}

TEST_P(UpsampleExactness, HoldsForImagesThatDoNotFillARegister) {
  for (const int width : {1, 2, 3, 5, 9, 15, 16, 17, 31})
    for (const int height : {1, 2, 9}) {
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
      ExpectByTheBook(RandomProblem(width, height, 2, 3), DepthWindow(4.0));
    }
}

TEST_P(UpsampleExactness, HoldsForSmallAndLargeDiscs) {
  const Problem problem = RandomProblem(41, 23, 4, 3);
  for (const auto& [sigma_px, radius_in_sigmas] :
       {std::pair{0.5, 0.5}, {0.9, 1.0}, {1.5, 1.5}, {5.3, 2.0}, {12.0, 4.0}, {60.0, 1.0}}) {
    SCOPED_TRACE(sigma_px);
    ExpectByTheBook(problem, DepthWindow(sigma_px, radius_in_sigmas));
  }
}

TEST_P(UpsampleExactness, HoldsFarAway) {
  ExpectByTheBook(RandomProblem(40, 24, 4, 6, 28.0), DepthWindow(8.0));
}

TEST_P(UpsampleExactness, HoldsForAnyNumberOfIterations) {
  const Problem problem = RandomProblem(40, 24, 4, 6);
  for (const int iterations : {0, 1, 12}) {
    SCOPED_TRACE(iterations);
    UpsampleOptions options = DepthWindow(8.0);
    options.iterations = iterations;
    ExpectByTheBook(problem, options);
  }
}

TEST_P(UpsampleExactness, ReportsTheIterationsAsTheyWere) {
  const Problem problem = RandomProblem(37, 21, 4, 6);
  UpsampleOptions options = DepthWindow(8.0);
  options.keep_iterations = true;
  const auto fast = UpsampleDepth(problem.samples, problem.guide, options, {});
  ASSERT_EQ(fast->iterations.size(), 6u);
  for (std::size_t t = 0; t < 6; ++t) {
    options.iterations = static_cast<int>(t);
    const DenseDepth plain = UpsampleByTheBook(problem.samples, problem.guide, options);
    double change = 0.0, pixels = 0.0;
    for (std::size_t i = 0; i < plain.depth_m.size(); ++i) {
      const float depth_m = fast->iterations[t].values()[i];
      ASSERT_EQ(std::isnan(depth_m), std::isnan(plain.depth_m.values()[i]));
      if (std::isnan(depth_m)) continue;
      ASSERT_NEAR(depth_m, plain.depth_m.values()[i], 2e-5);
      pixels += 1.0;
      if (t > 0)
        change += std::abs(static_cast<double>(depth_m - fast->iterations[t - 1].values()[i]));
    }
    ASSERT_GT(pixels, 0.0) << "no pixel has a depth";
    // A micrometre: the sum is over depths that were rounded to 0.1 micrometres.
    if (t > 0) {
      EXPECT_NEAR(fast->mean_change_m[t - 1], change / pixels, 1e-6);
    }
  }
}

TEST_P(UpsampleExactness, LeavesAPixelUnlikeAllSamplesEmpty) {
  Problem problem = RandomProblem(30, 20, 4, 6);
  for (auto& pixel : problem.guide.values()) pixel = {0, 0, 0};
  problem.guide(13, 11) = {255, 255, 255};  // K < 1e-35: no weight to speak of
  std::erase_if(problem.samples.samples, [](const AlignedSample& s) {
    return std::lround(s.u) == 13 && std::lround(s.v) == 11;
  });
  problem.samples.reasons.resize(problem.samples.samples.size());
  const auto dense = UpsampleDepth(problem.samples, problem.guide, DepthWindow(8.0), {});
  EXPECT_TRUE(std::isnan(dense->depth_m(13, 11)));
  EXPECT_EQ(dense->confidence(13, 11), 0.0f);
  EXPECT_FALSE(std::isnan(dense->depth_m(14, 11)));
}

TEST_P(UpsampleExactness, LiteralWeightsAreEquationEightAsPrinted) {
  const Problem problem = RandomProblem(33, 19, 4, 6);
  UpsampleOptions options = DepthWindow(8.0);
  options.weights = UpsampleOptions::Weights::kLiteral;
  const auto fast = UpsampleDepth(problem.samples, problem.guide, options, {});
  const DenseDepth plain = UpsampleByTheBook(problem.samples, problem.guide, options);
  for (std::size_t i = 0; i < plain.depth_m.size(); ++i) {
    ASSERT_NEAR(fast->depth_m.values()[i], plain.depth_m.values()[i], 2e-5);
    ASSERT_NEAR(fast->confidence.values()[i], plain.confidence.values()[i],
                1e-4 * plain.max_confidence);
  }
}

TEST_P(UpsampleExactness, EveryReadingOfEquationNineIsItsSum) {
  using Weights = UpsampleOptions::Weights;
  const Problem problem = RandomProblem(33, 19, 4, 6);
  for (const Weights weights : {Weights::kProduct, Weights::kLiteral})
    for (const Weights terms : {Weights::kProduct, Weights::kLiteral})
      for (const ConfidencePasses passes :
           {ConfidencePasses::kAll, ConfidencePasses::kEveryDepth, ConfidencePasses::kGuided}) {
        SCOPED_TRACE(testing::Message()
                     << "weights " << static_cast<int>(weights) << ", terms "
                     << static_cast<int>(terms) << ", passes " << static_cast<int>(passes));
        UpsampleOptions options = DepthWindow(8.0);
        options.weights = weights;
        options.confidence_terms = terms;
        options.confidence_passes = passes;
        ExpectByTheBook(problem, options);
        options.iterations = 1;
        ExpectByTheBook(problem, options);
      }
}

INSTANTIATE_TEST_SUITE_P(, UpsampleExactness, testing::ValuesIn(VectorTargets()), VectorTargetName);

}  // namespace
}  // namespace foresight
