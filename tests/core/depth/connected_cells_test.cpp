#include "core/depth/connected_cells.h"

#include <gtest/gtest.h>

#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

constexpr int kWidth = 81;
constexpr int kHeight = 61;
constexpr SampleSpacing kSpacing{4.0, 12.0};
constexpr double kTolerance_m = 0.05;

AlignedSamples Lattice(const std::function<double(int, int)>& depth_m) {
  return SamplesOnLattice(kWidth, kHeight, 4, 12, depth_m);
}

Result<MaskImage> Inside(const AlignedSamples& samples, float slope_x = 0.0f,
                         const RunContext& context = {}) {
  const SparseDepthMap map(samples);
  std::vector<SamplePlane> planes = LevelPlanes(map, samples);
  for (SamplePlane& plane : planes) plane.slope_x = slope_x;
  return InsideConnectedCells(map, samples, planes, kSpacing, kTolerance_m, context);
}

TEST(ConnectedCells, HoldAllPixelsBetweenSamplesOfOneSurface) {
  // The last samples are at u = 40 and v = 36.
  const auto inside = Inside(Lattice([](int u, int v) { return u <= 40 && v <= 36 ? 1.5 : NAN; }));
  ASSERT_TRUE(inside);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      ASSERT_EQ((*inside)(u, v), u <= 40 && v <= 36 ? 255 : 0) << u << ", " << v;
}

TEST(ConnectedCells, DoNotReachAcrossAStepInDepth) {
  const auto inside = Inside(Lattice([](int u, int) { return u <= 40 ? 1.5 : 1.6; }));
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      ASSERT_EQ((*inside)(u, v), u > 40 && u < 44 ? 0 : 255) << u << ", " << v;
}

TEST(ConnectedCells, FollowASlantedPlane) {
  // Steps of 0.1 to 0.4 m from sample to sample, above the tolerance.
  const float slope = 0.01f;
  const AlignedSamples samples =
      Lattice([&](int u, int) { return 1.0 / (0.3 + static_cast<double>(slope) * u); });
  const auto level = Inside(samples);
  const auto slanted = Inside(samples, slope);
  EXPECT_EQ((*level)(22, 30), 0);
  EXPECT_TRUE(std::all_of(slanted->values().begin(), slanted->values().end(),
                          [](std::uint8_t pixel) { return pixel == 255; }));
}

TEST(ConnectedCells, APlaneThatOnlyOneOfTwoSamplesHasConnectsNothing) {
  const float slope = 0.01f;
  const AlignedSamples samples =
      Lattice([&](int u, int) { return 1.0 / (0.3 + static_cast<double>(slope) * u); });
  const SparseDepthMap map(samples);
  std::vector<SamplePlane> planes = LevelPlanes(map, samples);
  for (std::size_t q = 0; q < planes.size(); ++q)
    if (map.columns()[q] <= 20) planes[q].slope_x = slope;
  const auto inside = InsideConnectedCells(map, samples, planes, kSpacing, kTolerance_m, {});
  EXPECT_EQ((*inside)(18, 30), 255);
  EXPECT_EQ((*inside)(22, 30), 0);
}

TEST(ConnectedCells, LeaveOutATornCell) {
  AlignedSamples samples = Lattice([](int u, int) { return u <= 60 ? 1.5 : NAN; });
  for (AlignedSample& s : samples.samples)
    if (s.u > 40.0f) s.u += 10.0f;  // 14 px from their neighbours, more than three spacings
  const auto inside = Inside(samples);
  EXPECT_EQ((*inside)(38, 30), 255);
  EXPECT_EQ((*inside)(47, 30), 0);
  EXPECT_EQ((*inside)(56, 30), 255);
}

TEST(ConnectedCells, KeepATriangleOfACellThatLostACorner) {
  // Without the sample at (40, 24) the four cells around it keep the triangles away from it.
  const auto inside = Inside(Lattice([](int u, int v) { return u == 40 && v == 24 ? NAN : 1.5; }));
  EXPECT_EQ((*inside)(40, 24), 0);
  EXPECT_EQ((*inside)(37, 14), 255);
  EXPECT_EQ((*inside)(43, 34), 255);
}

TEST(ConnectedCells, LeaveOutRejectedSamples) {
  AlignedSamples samples = Lattice([](int, int) { return 1.5; });
  for (std::size_t i = 0; i < samples.samples.size(); ++i)
    if (samples.samples[i].u == 40.0f) samples.reasons[i] = RejectReason::kFlipping;
  const auto inside = Inside(samples);
  EXPECT_EQ((*inside)(40, 30), 0);
  EXPECT_EQ((*inside)(36, 30), 255);
}

TEST(ConnectedCells, DoNotDependOnTheNumberOfThreads) {
  const AlignedSamples samples =
      Lattice([](int u, int v) { return u + v < 70 ? 1.5 : 1.5 + 0.02 * (u % 9); });
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(Inside(samples, 0.0f, one).value(), Inside(samples, 0.0f, four).value());
}

TEST(ConnectedCells, StopWhenCancelled) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto inside = Inside(Lattice([](int, int) { return 1.5; }), 0.0f, context);
  ASSERT_FALSE(inside);
  EXPECT_EQ(inside.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace foresight
