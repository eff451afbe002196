// The first-order kernel against its definition in double precision, on every instruction set.
#include <gtest/gtest.h>

#include "core/depth/plane_filter.h"
#include "tests/core/depth/plane_problem.h"
#include "tests/support/on_every_vector_target.h"

namespace foresight {
namespace {

struct Filtered {
  FloatImage depth_m, sum_gkh, sum_gk, sum_gh, slope_x, slope_y;
  std::vector<DepthImage> iterations;

  Filtered(int width, int height, std::size_t kept_iterations)
      : depth_m(width, height, -1.0f),
        sum_gkh(depth_m),
        sum_gk(depth_m),
        sum_gh(depth_m),
        slope_x(depth_m),
        slope_y(depth_m),
        iterations(kept_iterations, depth_m) {}

  /// Copies all rows of a block to the rows from `top` on.
  void Take(const Filtered& block, int top) {
    const auto copy = [&](const FloatImage& from, FloatImage& to) {
      std::copy_n(from.data(), from.size(), to.row(top));
    };
    copy(block.depth_m, depth_m);
    copy(block.sum_gkh, sum_gkh);
    copy(block.sum_gk, sum_gk);
    copy(block.sum_gh, sum_gh);
    copy(block.slope_x, slope_x);
    copy(block.slope_y, slope_y);
    for (std::size_t t = 0; t < iterations.size(); ++t) copy(block.iterations[t], iterations[t]);
  }
};

Filtered FilterRowsOf(const PlaneFilter& filter, int top, int bottom, std::size_t kept) {
  Filtered out(filter.samples.width(), bottom - top, kept);
  FilterPlaneRows(
      filter, top, bottom,
      {out.depth_m, out.sum_gkh, out.sum_gk, out.sum_gh, out.slope_x, out.slope_y, out.iterations});
  return out;
}

Filtered Filter(const PlaneProblem& problem, const PlaneReferenceOptions& options,
                std::size_t kept_iterations = 0) {
  const FilterOf of(problem, options);
  const int height = of.sparse().height();
  Filtered all(of.sparse().width(), height, kept_iterations);
  // Two blocks of odd heights, each in images of its own.
  for (const auto& [top, bottom] : {std::pair{0, height / 2}, {height / 2, height}})
    all.Take(FilterRowsOf(of.filter(), top, bottom, kept_iterations), top);
  return all;
}

/// Single against double precision: 0.05 mm and 1e-4 of the window's weight; a pixel between two
/// surfaces makes more of a rounding error with each pass.
void ExpectByTheBook(const PlaneProblem& problem, const PlaneReferenceOptions& options) {
  const Filtered fast = Filter(problem, options);
  int compared = 0;
  for (int y = 0; y < fast.depth_m.height(); ++y)
    for (int x = 0; x < fast.depth_m.width(); ++x) {
      SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
      const PlaneFit plain = FitPlaneByTheBook(problem, options, x, y);
      ASSERT_EQ(std::isnan(fast.depth_m(x, y)), std::isnan(plain.depth_m));
      if (!std::isnan(plain.depth_m)) {
        ++compared;
        ASSERT_NEAR(fast.depth_m(x, y), plain.depth_m, 5e-5);
      }
      const double weight = 1e-4 * (1.0 + plain.sum_gh);
      ASSERT_NEAR(fast.sum_gkh(x, y), plain.sum_gkh, weight);
      ASSERT_NEAR(fast.sum_gk(x, y), plain.sum_gk, weight);
      ASSERT_NEAR(fast.sum_gh(x, y), plain.sum_gh, weight);
      // Over the disc's radius, 1e-5 of an inverse metre: 0.02 mm at 1.5 m.
      const double slope = 1e-5 / (options.sigma_spatial_px * problem.planes.front().unit);
      ASSERT_NEAR(fast.slope_x(x, y), plain.slope_x, slope);
      ASSERT_NEAR(fast.slope_y(x, y), plain.slope_y, slope);
    }
  EXPECT_GT(compared, 0) << "no pixel has a depth";
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

TEST_P(PlaneKernel, IsItsDefinitionOverCurvedRays) {
  ExpectByTheBook(RandomProblem(64, 48, Rays::kCurved), Window(12.0, 12.0));
}

TEST_P(PlaneKernel, IsItsDefinitionFromALevelStart) {
  PlaneProblem problem = RandomProblem(64, 48, Rays::kCurved);
  for (SamplePlane& plane : problem.planes) {
    plane.slope_x = plane.slope_y = 0.0f;
    plane.support = 1.0f;
  }
  ExpectByTheBook(problem, Window(12.0, 12.0));
}

TEST_P(PlaneKernel, LeavesPixelsWithoutARayEmpty) {
  PlaneProblem problem = RandomProblem(33, 17, Rays::kCurved);
  auto rays = std::make_shared<RayField>(*problem.samples.rays);
  for (const auto& [x, y] : {std::pair{0, 0}, {15, 8}, {32, 16}})
    rays->x(x, y) = rays->y(x, y) = std::numeric_limits<float>::quiet_NaN();
  problem.samples.rays = rays;
  EXPECT_TRUE(std::isnan(Filter(problem, Window(8.0, 8.0)).depth_m(15, 8)));
  ExpectByTheBook(problem, Window(8.0, 8.0));
}

TEST_P(PlaneKernel, StartsAtTheBestSupportedSample) {
  // Two samples as near and alike: the pixel between them takes the one that its own surroundings
  // support, with that one's slopes.
  PlaneProblem problem;
  problem.samples = SamplesOnLattice(9, 1, 4, 1, [](int u, int) { return u < 4 ? 1.0 : 2.0; });
  for (FloatImage& channel : problem.colour) channel = FloatImage(9, 1, 50.0f);
  StartAnywhere(problem, Rays::kPixels, 0.0, 0.0);
  const auto start_at_2 = [&](float left_support, float right_support) {
    problem.planes[0].inverse_depth = 1.0f;
    problem.planes[1].inverse_depth = 0.5f;
    problem.planes[0].support = left_support;
    problem.planes[1].support = right_support;
    return Filter(problem, Window(3.0, 3.0), 6).iterations[0](2, 0);
  };
  EXPECT_NEAR(start_at_2(0.9f, 0.3f), 1.0 / (1.0 + 2.0 * problem.planes[0].slope_x), 1e-6);
  EXPECT_NEAR(start_at_2(0.3f, 0.9f), 1.0 / (0.5 - 2.0 * problem.planes[1].slope_x), 1e-6);
}

TEST_P(PlaneKernel, HoldsForImagesThatDoNotFillARegister) {
  for (const int width : {1, 2, 3, 9, 15, 17, 31})
    for (const int height : {1, 2, 7}) {
      SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
      ExpectByTheBook(RandomProblem(width, height), Window(6.0, 6.0));
      ExpectByTheBook(RandomProblem(width, height, Rays::kCurved), Window(6.0, 6.0));
    }
}

TEST_P(PlaneKernel, HoldsForSmallAndLargeDiscs) {
  const PlaneProblem problem = RandomProblem(41, 23);
  for (const auto& [sigma_px, radius_px] :
       {std::pair{0.5, 0.25}, {1.2, 1.7}, {5.0, 10.0}, {12.0, 24.0}, {40.0, 40.0}}) {
    SCOPED_TRACE(sigma_px);
    ExpectByTheBook(problem, Window(sigma_px, radius_px));
  }
}

TEST_P(PlaneKernel, HoldsForOnePassAndForMany) {
  const PlaneProblem problem = RandomProblem(40, 24);
  for (const int iterations : {1, 2, 12}) {
    SCOPED_TRACE(iterations);
    PlaneReferenceOptions options = Window(8.0, 16.0);
    options.iterations = iterations;
    ExpectByTheBook(problem, options);
  }
}

TEST_P(PlaneKernel, HandsOutEachIteration) {
  const PlaneProblem problem = RandomProblem(33, 17);
  PlaneReferenceOptions options = Window(8.0, 8.0);
  options.iterations = 3;
  const Filtered all = Filter(problem, options, 4);
  EXPECT_EQ(all.iterations[3], all.depth_m);
  for (options.iterations = 1; options.iterations < 3; ++options.iterations)
    EXPECT_EQ(all.iterations[static_cast<std::size_t>(options.iterations)],
              Filter(problem, options).depth_m);
  // The start is the plane of one of the samples, moved halfway to the sample.
  int starts = 0;
  for (std::size_t i = 0; i < problem.planes.size(); ++i) {
    const SamplePlane& s = problem.planes[i];
    const double there = 0.5 * (s.inverse_depth + 1.0 / problem.samples.samples[i].depth_m);
    const double here = there + s.slope_x * (16 - s.x) + s.slope_y * (8 - s.y);
    starts += std::abs(1.0 / here - all.iterations[0](16, 8)) < 1e-6 ? 1 : 0;
  }
  EXPECT_EQ(starts, 1);
}

TEST_P(PlaneKernel, FollowsAPlaneExactly) {
  PlaneProblem problem;
  problem.samples = SamplesOnLattice(
      80, 40, 4, 6, [](int u, int v) { return 1.0 / (0.7 + 0.004 * u - 0.002 * v); });
  for (FloatImage& plane : problem.colour) plane = FloatImage(80, 40, 50.0f);
  StartAnywhere(problem, Rays::kPixels, 0.004, -0.002);
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
  PlaneProblem problem = RandomProblem(60, 20);
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
