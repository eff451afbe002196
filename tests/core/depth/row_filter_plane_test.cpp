// The first-order kernel against its definition in double precision, on every instruction set.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/depth/row_filter.h"
#include "tests/support/on_every_vector_target.h"
#include "tests/support/plane_reference.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

struct Problem {
  AlignedSamples samples;
  std::array<FloatImage, 3> colour;
};

/// Two slanted surfaces with an edge in depth and colour, noise in both, samples off the centres.
Problem RandomProblem(int width, int height, double depth_m = 1.5) {
  Random random(7);
  Problem problem;
  problem.samples = SamplesOnLattice(width, height, 3, 4, [&](int u, int v) {
    const double inverse = (u < width / 2 ? 1.0 : 0.8) + 0.002 * u - 0.003 * v;
    return depth_m / inverse + 0.005 * random.Normal();
  });
  for (AlignedSample& s : problem.samples.samples) {
    s.u = std::clamp(s.u + static_cast<float>(random.Normal()), -0.49f,
                     static_cast<float>(width) - 0.51f);
    s.v = std::clamp(s.v + static_cast<float>(random.Normal()), -0.49f,
                     static_cast<float>(height) - 0.51f);
  }
  for (FloatImage& plane : problem.colour) {
    plane = FloatImage(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        plane(x, y) = static_cast<float>((x < width / 2 ? 20.0 : 60.0) + 8.0 * random.Normal());
  }
  return problem;
}

struct Filtered {
  FloatImage depth_m, sum_gkh, sum_gk, sum_gh, slope_x, slope_y;
};

Filtered Filter(const Problem& problem, const PlaneReferenceOptions& options,
                std::span<DepthImage> iterations = {}) {
  const SparseDepthMap sparse(problem.samples);
  const SpatialKernel spatial(options.sigma_spatial_px, options.radius_px);
  PlaneFilter filter{sparse, spatial, {}, {}};
  std::array<std::vector<float>, 3> sample_colour;
  for (std::size_t i = 0; i < 3; ++i) {
    sample_colour[i] = sparse.ValuesAt(problem.colour[i]);
    filter.colour[i] = &problem.colour[i];
    filter.sample_colour[i] = sample_colour[i];
  }
  filter.sigma_spatial_px = static_cast<float>(options.sigma_spatial_px);
  filter.sigma_colour = static_cast<float>(options.sigma_colour);
  filter.sigma_depth_m = static_cast<float>(options.sigma_depth_m);
  filter.ridge = static_cast<float>(options.ridge);
  filter.iterations = options.iterations;
  const FloatImage empty(sparse.width(), sparse.height(), -1.0f);
  Filtered out{empty, empty, empty, empty, empty, empty};
  const PlaneFilterOutput output{out.depth_m, out.sum_gkh, out.sum_gk, out.sum_gh,
                                 out.slope_x, out.slope_y, iterations};
  // Two blocks of odd heights: what a block does not own it must not touch.
  FilterPlaneRows(filter, 0, sparse.height() / 2, output);
  FilterPlaneRows(filter, sparse.height() / 2, sparse.height(), output);
  return out;
}

/// Single against double precision: 0.05 mm and 1e-4 of the window's weight; a pixel between two
/// surfaces makes more of a rounding error with each pass.
void ExpectByTheBook(const Problem& problem, const PlaneReferenceOptions& options) {
  const Filtered fast = Filter(problem, options);
  for (int y = 0; y < fast.depth_m.height(); ++y)
    for (int x = 0; x < fast.depth_m.width(); ++x) {
      SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
      const PlaneFit plain = FitPlaneByTheBook(problem.samples, problem.colour, options, x, y);
      ASSERT_EQ(std::isnan(fast.depth_m(x, y)), std::isnan(plain.depth_m));
      if (!std::isnan(plain.depth_m)) {
        ASSERT_NEAR(fast.depth_m(x, y), plain.depth_m, 5e-5);
      }
      const double weight = 1e-4 * (1.0 + plain.sum_gh);
      ASSERT_NEAR(fast.sum_gkh(x, y), plain.sum_gkh, weight);
      ASSERT_NEAR(fast.sum_gk(x, y), plain.sum_gk, weight);
      ASSERT_NEAR(fast.sum_gh(x, y), plain.sum_gh, weight);
      // Over the disc's radius, 1e-5 of an inverse metre: 0.02 mm at 1.5 m.
      ASSERT_NEAR(fast.slope_x(x, y), plain.slope_x, 1e-5 / options.sigma_spatial_px);
      ASSERT_NEAR(fast.slope_y(x, y), plain.slope_y, 1e-5 / options.sigma_spatial_px);
    }
}

PlaneReferenceOptions Window(double sigma_px, double radius_px) {
  PlaneReferenceOptions options;
  options.sigma_spatial_px = sigma_px;
  options.radius_px = radius_px;
  return options;
}

class PlaneKernel : public OnEveryVectorTarget {};

TEST_P(PlaneKernel, IsItsDefinition) {
  ExpectByTheBook(RandomProblem(64, 48), Window(12.0, 12.0));
}

TEST_P(PlaneKernel, HoldsForImagesThatDoNotFillARegister) {
  for (const int width : {1, 2, 3, 9, 15, 17, 31})
    for (const int height : {1, 2, 7}) {
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
      ExpectByTheBook(RandomProblem(width, height), Window(6.0, 6.0));
    }
}

TEST_P(PlaneKernel, HoldsForSmallAndLargeDiscs) {
  const Problem problem = RandomProblem(41, 23);
  for (const auto& [sigma_px, radius_px] :
       {std::pair{0.5, 0.25}, {1.2, 1.7}, {5.0, 10.0}, {12.0, 24.0}, {40.0, 40.0}}) {
    SCOPED_TRACE(sigma_px);
    ExpectByTheBook(problem, Window(sigma_px, radius_px));
  }
}

TEST_P(PlaneKernel, HoldsForOnePassAndForMany) {
  const Problem problem = RandomProblem(40, 24);
  for (const int iterations : {1, 2, 12}) {
    SCOPED_TRACE(iterations);
    PlaneReferenceOptions options = Window(8.0, 16.0);
    options.iterations = iterations;
    ExpectByTheBook(problem, options);
  }
}

TEST_P(PlaneKernel, HandsOutEachIteration) {
  const Problem problem = RandomProblem(33, 17);
  PlaneReferenceOptions options = Window(8.0, 8.0);
  options.iterations = 3;
  std::vector<DepthImage> iterations(4, DepthImage(33, 17));
  const Filtered all = Filter(problem, options, iterations);
  EXPECT_EQ(iterations[3], all.depth_m);
  for (options.iterations = 1; options.iterations < 3; ++options.iterations)
    EXPECT_EQ(iterations[static_cast<std::size_t>(options.iterations)],
              Filter(problem, options).depth_m);
  // The start is a sample's own depth.
  const auto is_start = [&](const AlignedSample& s) {
    return std::abs(s.depth_m - iterations[0](16, 8)) < 1e-6f;
  };
  EXPECT_TRUE(
      std::any_of(problem.samples.samples.begin(), problem.samples.samples.end(), is_start));
}

TEST_P(PlaneKernel, FollowsAPlaneExactly) {
  Problem problem;
  problem.samples = SamplesOnLattice(
      80, 40, 4, 6, [](int u, int v) { return 1.0 / (0.7 + 0.004 * u - 0.002 * v); });
  for (FloatImage& plane : problem.colour) plane = FloatImage(80, 40, 50.0f);
  PlaneReferenceOptions options = Window(15.0, 15.0);
  options.ridge = 0.0;  // a ridge pulls slopes to zero
  options.sigma_depth_m = 1.0;
  const Filtered fast = Filter(problem, options);
  // Digits of a float: a micrometre at 1.4 m, 1e-7 per pixel and metre.
  EXPECT_NEAR(fast.depth_m(41, 20), 1.0 / (0.7 + 0.004 * 41 - 0.002 * 20), 1e-6);
  EXPECT_NEAR(fast.slope_x(41, 20), 0.004, 1e-7);
  EXPECT_NEAR(fast.slope_y(41, 20), -0.002, 1e-7);
}

TEST_P(PlaneKernel, LeavesPixelsOutOfReachEmpty) {
  Problem problem = RandomProblem(60, 20);
  for (std::size_t i = 0; i < problem.samples.samples.size(); ++i)
    if (problem.samples.samples[i].u > 20.0f) problem.samples.reasons[i] = RejectReason::kFlying;
  const Filtered fast = Filter(problem, Window(6.0, 6.0));
  EXPECT_TRUE(std::isnan(fast.depth_m(50, 10)));
  EXPECT_EQ(fast.sum_gh(50, 10), 0.0f);
  EXPECT_EQ(fast.slope_x(50, 10), 0.0f);
  EXPECT_FALSE(std::isnan(fast.depth_m(10, 10)));
}

INSTANTIATE_TEST_SUITE_P(, PlaneKernel, testing::ValuesIn(VectorTargets()), VectorTargetName);

}  // namespace
}  // namespace foresight
