#include "core/depth/sample_planes.h"

#include <gtest/gtest.h>

#include "core/sensor/camera_model.h"
#include "tests/core/depth/plane_problem.h"
#include "tests/support/on_every_vector_target.h"

namespace foresight {
namespace {

constexpr double kSlopeX = 0.004;
constexpr double kSlopeY = -0.006;

double PlaneInPixels(int u, int v) {
  return 1.0 / (0.9 + kSlopeX * u + kSlopeY * v);
}

/// The index into the map of a place on the lidar's grid.
std::size_t At(const SparseDepthMap& map, const AlignedSamples& samples, int beam, int line) {
  return static_cast<std::size_t>(MapGrid(map, samples)(beam, line));
}

TEST(LevelPlanes, LieAtTheSamplesExactPixelsWithoutRays) {
  AlignedSamples samples = SamplesOnLattice(80, 60, 4, 12, PlaneInPixels);
  for (AlignedSample& s : samples.samples) s.u += 0.3f;
  const SparseDepthMap map(samples);
  const std::vector<SamplePlane> planes = LevelPlanes(map, samples);
  ASSERT_EQ(planes.size(), samples.samples.size());
  const SamplePlane& plane = planes[At(map, samples, 5, 2)];
  EXPECT_FLOAT_EQ(plane.x, 20.3f);
  EXPECT_FLOAT_EQ(plane.y, 24.0f);
  EXPECT_FLOAT_EQ(plane.unit, 1.0f);
  EXPECT_FLOAT_EQ(plane.inverse_depth, static_cast<float>(1.0 / PlaneInPixels(20, 24)));
  EXPECT_EQ(plane.slope_x, 0.0f);
  EXPECT_EQ(plane.slope_y, 0.0f);
}

TEST(LevelPlanes, LieOnTheSamplesExactRaysWithThem) {
  AlignedSamples samples = SamplesOnLattice(80, 60, 4, 12, PlaneInPixels);
  samples.rays = RaysOf(PinholeCamera(80, 60, 500.0, 40.0, 30.0));
  for (AlignedSample& s : samples.samples) s.point.x() += 0.0005f * s.depth_m;
  const SparseDepthMap map(samples);
  const std::vector<SamplePlane> planes = LevelPlanes(map, samples);
  for (const int beam : {0, 5, samples.beams - 1}) {
    const SamplePlane& plane = planes[At(map, samples, beam, 2)];
    EXPECT_NEAR(plane.x, (4 * beam - 40) / 500.0 + 0.0005, 1e-7);
    EXPECT_NEAR(plane.y, (24 - 30) / 500.0, 1e-7);
    EXPECT_NEAR(plane.unit, 1.0 / 500.0, 1e-7);
  }
}

TEST(LevelPlanes, TheirUnitIsThatOfTheLensThere) {
  CameraModel camera = PinholeCamera(201, 3, 100.0, 100.0, 1.0);
  camera.lens = FisheyeLens{1.0};
  AlignedSamples samples = SamplesOnLattice(201, 3, 100, 1, [](int, int) { return 1.0; });
  samples.rays = RaysOf(camera);
  const SparseDepthMap map(samples);
  const std::vector<SamplePlane> planes = LevelPlanes(map, samples);
  // X/Z = tan(u / f): 1/f in the middle, and 1/(f cos^2) one radian aside. At the border only one
  // neighbour tells, half a pixel off.
  EXPECT_NEAR(planes[At(map, samples, 1, 1)].unit, 0.01, 1e-5);
  EXPECT_NEAR(planes[At(map, samples, 2, 1)].unit, 0.01 / std::pow(std::cos(0.995), 2.0), 1e-4);
}

TEST(SlopesOnGrid, AreThoseOfAPlane) {
  const AlignedSamples samples = SamplesOnLattice(80, 60, 4, 12, PlaneInPixels);
  const SparseDepthMap map(samples);
  const auto slopes = SlopesOnGrid(map, samples, LevelPlanes(map, samples));
  const SlopeCandidates& inner = slopes[At(map, samples, 9, 2)];
  EXPECT_EQ(inner.x[0], 0.0f);
  EXPECT_EQ(inner.y[0], 0.0f);
  // Digits of an inverse depth near 1, over four pixels.
  for (std::size_t k = 1; k < 7; ++k) {
    EXPECT_NEAR(inner.x[k], kSlopeX, 1e-6);
    EXPECT_NEAR(inner.y[k], kSlopeY, 1e-6);
  }
  // In a corner one pair is left.
  const SlopeCandidates& corner = slopes[At(map, samples, 0, 0)];
  EXPECT_NEAR(corner.x[1], kSlopeX, 1e-6);
  EXPECT_NEAR(corner.y[1], kSlopeY, 1e-6);
  EXPECT_EQ(corner.x[2], 0.0f);
  EXPECT_EQ(corner.y[2], 0.0f);
}

TEST(SlopesOnGrid, AreThoseOfAPlaneOverRaysToo) {
  // Over a pinhole's rays, f = 500 px, a slope is 500 times as large.
  AlignedSamples samples = SamplesOnLattice(80, 60, 4, 12, PlaneInPixels);
  samples.rays = RaysOf(PinholeCamera(80, 60, 500.0, 40.0, 30.0));
  const SparseDepthMap map(samples);
  const auto slopes = SlopesOnGrid(map, samples, LevelPlanes(map, samples));
  const SlopeCandidates& inner = slopes[At(map, samples, 9, 2)];
  for (std::size_t k = 1; k < 7; ++k) {
    EXPECT_NEAR(inner.x[k], 500.0 * kSlopeX, 1e-3);
    EXPECT_NEAR(inner.y[k], 500.0 * kSlopeY, 1e-3);
  }
}

TEST(SlopesOnGrid, AreLevelForASampleWithoutNeighbours) {
  const AlignedSamples samples =
      SamplesOnLattice(80, 60, 4, 12, [](int u, int v) { return u == 40 && v == 24 ? 1.0 : NAN; });
  const SparseDepthMap map(samples);
  const auto slopes = SlopesOnGrid(map, samples, LevelPlanes(map, samples));
  ASSERT_EQ(slopes.size(), 1u);
  for (std::size_t k = 0; k < SlopeCandidates::kCount; ++k) {
    EXPECT_EQ(slopes[0].x[k], 0.0f);
    EXPECT_EQ(slopes[0].y[k], 0.0f);
  }
}

/// FitSamplePlanes over two blocks of rows.
std::vector<SamplePlane> Fit(const FilterOf& of, std::span<const SlopeCandidates> candidates) {
  std::vector<SamplePlane> planes = of.planes();
  const int height = of.sparse().height();
  FitSamplePlanes(of.filter(), candidates, 0, height / 2, planes);
  FitSamplePlanes(of.filter(), candidates, height / 2, height, planes);
  return planes;
}

class SamplePlaneKernel : public OnEveryVectorTarget {};

/// The result is what one of the best supported candidates arrives at: two within 1e-3 of each
/// other's support may change places in single precision.
void ExpectAWinner(const SamplePlane& fast,
                   const std::array<PlaneFit, SlopeCandidates::kCount>& plain,
                   const PlaneReferenceOptions& options) {
  double best = 0.0;
  for (const PlaneFit& fit : plain) best = std::max(best, fit.sum_gkh);
  const double slope = 1e-4 / (options.sigma_spatial_px * fast.unit);
  const bool is_one = std::any_of(plain.begin(), plain.end(), [&](const PlaneFit& fit) {
    return fit.sum_gkh >= 0.999 * best && std::abs(1.0 / fast.inverse_depth - fit.depth_m) < 1e-4 &&
           std::abs(fast.slope_x - fit.slope_x) < slope &&
           std::abs(fast.slope_y - fit.slope_y) < slope &&
           std::abs(fast.support - fit.sum_gkh / fit.sum_gk) < 1e-4;
  });
  EXPECT_TRUE(is_one) << 1.0 / fast.inverse_depth << " m, slopes " << fast.slope_x << ", "
                      << fast.slope_y << ", support " << fast.support
                      << "; the reference's first: " << plain[0].depth_m << " m, "
                      << plain[0].slope_x << ", " << plain[0].slope_y;
}

void ExpectPlanesByTheBook(const PlaneProblem& problem, const PlaneReferenceOptions& options) {
  const FilterOf of(problem, options);
  Random random(5);
  std::vector<SlopeCandidates> candidates(of.sparse().size());
  for (std::size_t q = 0; q < candidates.size(); ++q)
    for (std::size_t k = 0; k < SlopeCandidates::kCount; ++k) {
      candidates[q].x[k] = static_cast<float>(0.006 * random.Normal()) / of.planes()[q].unit;
      candidates[q].y[k] = static_cast<float>(0.006 * random.Normal()) / of.planes()[q].unit;
    }
  const std::vector<SamplePlane> planes = Fit(of, candidates);
  for (std::size_t q = 0; q < planes.size(); ++q) {
    SCOPED_TRACE(q);
    EXPECT_EQ(planes[q].x, of.planes()[q].x);
    EXPECT_EQ(planes[q].y, of.planes()[q].y);
    const auto source = static_cast<std::size_t>(of.sparse().sources()[q]);
    ExpectAWinner(planes[q], FitCandidatesByTheBook(problem, options, candidates[q], source),
                  options);
  }
}

PlaneReferenceOptions PlaneWindow(double sigma_px, double radius_px, int iterations = 4) {
  PlaneReferenceOptions options;
  options.sigma_spatial_px = sigma_px;
  options.radius_px = radius_px;
  options.iterations = iterations;
  return options;
}

TEST_P(SamplePlaneKernel, IsItsDefinition) {
  ExpectPlanesByTheBook(RandomProblem(64, 48), PlaneWindow(12.0, 12.0));
}

TEST_P(SamplePlaneKernel, IsItsDefinitionOverCurvedRays) {
  ExpectPlanesByTheBook(RandomProblem(64, 48, Rays::kCurved), PlaneWindow(12.0, 24.0));
}

TEST_P(SamplePlaneKernel, HoldsForFewSamplesAndForManyPasses) {
  for (const auto& [width, height, radius_px, iterations] :
       {std::tuple{1, 1, 6.0, 4}, {3, 9, 6.0, 1}, {17, 2, 0.25, 4}, {31, 7, 30.0, 12}}) {
    SCOPED_TRACE(width);
    ExpectPlanesByTheBook(RandomProblem(width, height), PlaneWindow(6.0, radius_px, iterations));
  }
}

TEST_P(SamplePlaneKernel, FindsAPlaneTooSteepForALevelStart) {
  // Neighbours on a line differ by 180 mm, six sigma_d, at 1.5 m; by more farther away.
  const auto steep = [](int u, int) { return 1.0 / (2.0 / 3.0 + 0.02 * (u - 20)); };
  PlaneProblem problem;
  problem.samples = SamplesOnLattice(40, 60, 4, 12, steep);
  for (FloatImage& channel : problem.colour) channel = FloatImage(40, 60, 50.0f);
  const SparseDepthMap map(problem.samples);
  problem.planes = LevelPlanes(map, problem.samples);  // a lattice is in the map's order already
  PlaneReferenceOptions options = PlaneWindow(12.0, 24.0);
  options.ridge = 1e-4;  // a larger one keeps slopes small
  const FilterOf of(problem, options);
  const std::vector<SlopeCandidates> level(map.size());
  const auto on_grid = SlopesOnGrid(map, problem.samples, of.planes());
  const std::size_t middle = At(map, problem.samples, 5, 2);
  EXPECT_LT(Fit(of, level)[middle].slope_x, 0.01f);
  const std::vector<SamplePlane> planes = Fit(of, on_grid);
  for (std::size_t q = 0; q < planes.size(); ++q) {
    ASSERT_NEAR(planes[q].slope_x, 0.02, 2e-4) << map.columns()[q];
    ASSERT_NEAR(planes[q].slope_y, 0.0, 1e-4);
    ASSERT_NEAR(planes[q].inverse_depth * map.depths_m()[q], 1.0, 1e-3);
    ASSERT_GT(planes[q].support, 0.9f);
  }
}

TEST_P(SamplePlaneKernel, AFloatingSampleHasLittleSupport) {
  PlaneProblem problem;
  problem.samples =
      SamplesOnLattice(80, 60, 4, 12, [](int u, int v) { return u == 40 && v == 24 ? 1.5 : 2.0; });
  for (FloatImage& channel : problem.colour) channel = FloatImage(80, 60, 50.0f);
  const SparseDepthMap map(problem.samples);
  problem.planes = LevelPlanes(map, problem.samples);
  const FilterOf of(problem, PlaneWindow(12.0, 24.0));
  const auto planes = Fit(of, SlopesOnGrid(map, problem.samples, of.planes()));
  // About forty samples are in its disc; next to it they agree with each other.
  EXPECT_LT(planes[At(map, problem.samples, 10, 2)].support, 0.3f);
  EXPECT_GT(planes[At(map, problem.samples, 11, 2)].support, 0.9f);
}

INSTANTIATE_TEST_SUITE_P(, SamplePlaneKernel, testing::ValuesIn(VectorTargets()), VectorTargetName);

}  // namespace
}  // namespace foresight
