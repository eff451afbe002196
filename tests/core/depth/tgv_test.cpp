#include "core/depth/tgv.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

ColorImage GuideWithAnEdge(int width, int height, int edge_x) {
  ColorImage guide(width, height, {230, 230, 230});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < edge_x; ++x) guide(x, y) = {20, 20, 20};
  return guide;
}

double PlaneDepth(int u, int v) {
  return 2.0 + 0.006 * u - 0.004 * v;
}

TEST(UpsampleTgv, ReconstructsAPlaneFromSparseSamplesUpToTheBorder) {
  const AlignedSamples samples = SamplesOnLattice(60, 44, 4, 8, PlaneDepth);
  TgvOptions patient;
  patient.iterations = 2000;
  const auto dense = UpsampleTgv(samples, ColorImage(60, 44, {128, 128, 128}), patient, {});
  ASSERT_TRUE(dense) << dense.error().message;
  // The plane has no cost, so it is the minimum; 0.1 mm is what the steps leave in the corners. A
  // first-order method is off by 18 mm in the column that lies 3 px beyond the last samples.
  for (int y = 0; y < 44; ++y)
    for (int x = 0; x < 60; ++x)
      ASSERT_NEAR(dense->depth_m(x, y), PlaneDepth(x, y), 1e-4) << x << ", " << y;
}

TEST(UpsampleTgv, DoesNotBlurAcrossAStrongEdgeOfTheGuide) {
  const AlignedSamples samples =
      SamplesOnLattice(80, 40, 4, 8, [](int u, int) { return u < 42 ? 1.0 : 2.0; });
  const auto dense = UpsampleTgv(samples, GuideWithAnEdge(80, 40, 42), {}, {});
  ASSERT_TRUE(dense);
  // Without the guide both are 1.37. With it the step of 1 m costs less than a thousandth there of
  // what it costs elsewhere; 5 mm is what 600 steps leave.
  EXPECT_NEAR(dense->depth_m(41, 20), 1.0, 5e-3);
  EXPECT_NEAR(dense->depth_m(42, 20), 2.0, 5e-3);
}

TEST(UpsampleTgv, WithoutTextureTheNoiseOfAWallIsSmoothed) {
  Random random(6);
  const AlignedSamples samples = SamplesOnLattice(
      80, 48, 4, 8, [&](int u, int v) { return PlaneDepth(u, v) + 0.01 * random.Normal(); });
  const auto dense = UpsampleTgv(samples, ColorImage(80, 48, {128, 128, 128}), {}, {});
  ASSERT_TRUE(dense);
  double squares = 0.0;
  for (const AlignedSample& s : samples.samples) {
    const auto u = static_cast<int>(s.u), v = static_cast<int>(s.v);
    squares += std::pow(dense->depth_m(u, v) - PlaneDepth(u, v), 2.0);
  }
  // At its samples an interpolation would keep all of the 10 mm.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(samples.samples.size())), 0.008);
}

TEST(UpsampleTgv, OneSampleFillsTheImage) {
  const AlignedSamples samples =
      SamplesOnLattice(50, 40, 5, 5, [](int u, int v) { return u == 25 && v == 10 ? 1.7 : NAN; });
  ASSERT_EQ(samples.samples.size(), 1u);
  const auto dense = UpsampleTgv(samples, GuideWithAnEdge(50, 40, 20), {}, {});
  ASSERT_TRUE(dense);
  for (const float depth_m : dense->depth_m.values()) ASSERT_NEAR(depth_m, 1.7f, 1e-5f);
}

TEST(UpsampleTgv, TrustsEveryPixelAlike) {
  const AlignedSamples samples = SamplesOnLattice(60, 44, 4, 8, PlaneDepth);
  const auto dense = UpsampleTgv(samples, ColorImage(60, 44), {}, {});
  ASSERT_TRUE(dense);
  EXPECT_EQ(dense->confidence, FloatImage(60, 44, 1.0f));
  EXPECT_EQ(dense->max_confidence, 1.0f);
  EXPECT_FALSE(dense->has_confidence) << "the 1 is the lidar's coverage";
}

TEST(UpsampleTgv, DoesNotDependOnTheNumberOfThreads) {
  const AlignedSamples samples = SamplesOnLattice(60, 100, 4, 8, PlaneDepth);
  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  TgvOptions options;
  options.iterations = 50;
  const ColorImage guide = GuideWithAnEdge(60, 100, 30);
  EXPECT_EQ(UpsampleTgv(samples, guide, options, one)->depth_m,
            UpsampleTgv(samples, guide, options, two)->depth_m);
}

TEST(UpsampleTgv, StopsWhenCancelled) {
  const AlignedSamples samples = SamplesOnLattice(60, 44, 4, 8, PlaneDepth);
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const auto dense = UpsampleTgv(samples, ColorImage(60, 44), {}, context);
  ASSERT_FALSE(dense);
  EXPECT_EQ(dense.error().code, ErrorCode::kCancelled);
}

TEST(UpsampleTgv, RefusesAGuideOfAnotherSize) {
  const AlignedSamples samples = SamplesOnLattice(60, 44, 4, 8, PlaneDepth);
  const auto dense = UpsampleTgv(samples, ColorImage(59, 44), {}, {});
  ASSERT_FALSE(dense);
  EXPECT_EQ(dense.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(dense.error().message.find("59 x 44"), std::string::npos);
}

TEST(UpsampleTgv, RefusesToInventFromNothing) {
  AlignedSamples samples = SamplesOnLattice(60, 44, 4, 8, PlaneDepth);
  std::fill(samples.reasons.begin(), samples.reasons.end(), RejectReason::kFlipping);
  EXPECT_EQ(UpsampleTgv(samples, ColorImage(60, 44), {}, {}).error().code,
            ErrorCode::kTooFewPoints);
}

TEST(TgvOptions, NamesTheMemberAtFault) {
  TgvOptions options;
  options.straightness = -1.0;
  ASSERT_FALSE(options.Check());
  EXPECT_NE(options.Check().error().message.find("straightness"), std::string::npos);
}

}  // namespace
}  // namespace foresight
