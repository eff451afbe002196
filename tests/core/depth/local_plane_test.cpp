#include "core/depth/local_plane.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/depth/depth_method.h"
#include "core/depth/local_plane_upsampler.h"
#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

ColorImage Grey(int width, int height) {
  return ColorImage(width, height, {128, 128, 128});
}

LocalPlaneOptions Window() {
  LocalPlaneOptions options;
  options.sigma_spatial_px = 10.0;
  return options;
}

/// Inverse depth linear in the pixels: a plane in space, up to 3 mm a pixel. Much steeper ones are
/// beyond a level start: see docs/evaluation/depth.md.
double SlantedPlane(int u, int v) {
  return 1.0 / (0.5 + 0.0008 * u - 0.0006 * v);
}

TEST(LocalPlanes, ReproduceASlantedPlaneExactly) {
  const AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, SlantedPlane);
  const auto dense = UpsampleLocalPlanes(samples, Grey(160, 120), Window(), {});
  ASSERT_TRUE(dense);
  // Three passes from a level start, and the ridge on the slopes, leave up to 4 mm at 2 m.
  for (int v = 24; v < 96; ++v)
    for (int u = 24; u < 136; ++u)
      ASSERT_NEAR(dense->depth_m(u, v), SlantedPlane(u, v), 0.004) << u << ", " << v;
}

TEST(LocalPlanes, ThePapersAverageIsBiasedThere) {
  const AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, SlantedPlane);
  UpsampleOptions options;
  options.sigma_spatial_px = 10.0;
  const auto dense = UpsampleDepth(samples, Grey(160, 120), options, {});
  double worst = 0.0;
  for (int v = 24; v < 96; ++v)
    for (int u = 24; u < 136; ++u)
      worst = std::max(worst, std::abs(dense->depth_m(u, v) - SlantedPlane(u, v)));
  EXPECT_GT(worst, 0.005);
}

TEST(LocalPlanes, KeepAnEdgeOfTheGuide) {
  ColorImage guide(160, 120, {210, 60, 60});
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 81; ++u) guide(u, v) = {60, 60, 190};
  const AlignedSamples samples =
      SamplesOnLattice(160, 120, 4, 12, [](int u, int) { return u < 81 ? 1.0 : 2.0; });
  const auto dense = UpsampleLocalPlanes(samples, guide, Window(), {});
  ASSERT_TRUE(dense);
  EXPECT_NEAR(dense->depth_m(80, 60), 1.0, 1e-3);
  EXPECT_NEAR(dense->depth_m(81, 60), 2.0, 1e-3);
}

TEST(LocalPlanes, TrustPixelsAmongSamplesAndNotThoseInAHole) {
  const auto hole = [](int u, int v) { return u > 60 && u < 110 && v > 30 && v < 90 ? NAN : 1.5; };
  const AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, hole);
  const auto dense = UpsampleLocalPlanes(samples, Grey(160, 120), Window(), {});
  ASSERT_TRUE(dense);
  EXPECT_GT(dense->confidence(30, 60), 0.9f);
  EXPECT_LT(dense->confidence(75, 60), 0.3f);
}

TEST(LocalPlanes, TheirConfidenceIsAbsolute) {
  // Twice as many samples in a corner do not lower the confidence elsewhere, as a fraction of the
  // largest would.
  AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, [](int, int) { return 1.5; });
  LocalPlaneOptions options = Window();
  options.along_line_px = 4.0;
  options.between_lines_px = 12.0;
  const float before =
      UpsampleLocalPlanes(samples, Grey(160, 120), options, {})->confidence(100, 60);
  for (std::size_t i = 0; i < 30; ++i) {
    samples.samples.push_back(samples.samples[i]);
    samples.samples.back().line = samples.lines - 1;
    samples.reasons.push_back(RejectReason::kKept);
  }
  const auto dense = UpsampleLocalPlanes(samples, Grey(160, 120), options, {});
  EXPECT_EQ(dense->max_confidence, 1.0f);
  EXPECT_EQ(dense->confidence(100, 60), before);
}

TEST(LocalPlanes, HandOutTheirPassesWhenAsked) {
  Random random(3);
  const AlignedSamples samples = SamplesOnLattice(
      160, 120, 4, 12, [&](int u, int v) { return SlantedPlane(u, v) + 0.01 * random.Normal(); });
  LocalPlaneOptions options = Window();
  const auto plain = UpsampleLocalPlanes(samples, Grey(160, 120), options, {});
  options.keep_iterations = true;
  const auto kept = UpsampleLocalPlanes(samples, Grey(160, 120), options, {});
  ASSERT_EQ(kept->iterations.size(), 3u);
  ASSERT_EQ(kept->mean_change_m.size(), 2u);
  EXPECT_EQ(kept->depth_m, plain->depth_m);
  EXPECT_LT(kept->mean_change_m[1], kept->mean_change_m[0]);
}

TEST(LocalPlanes, DoNotDependOnTheNumberOfThreads) {
  const AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, SlantedPlane);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const auto a = UpsampleLocalPlanes(samples, Grey(160, 120), Window(), one);
  const auto b = UpsampleLocalPlanes(samples, Grey(160, 120), Window(), four);
  EXPECT_EQ(a->depth_m, b->depth_m);
  EXPECT_EQ(a->confidence, b->confidence);
}

TEST(LocalPlanes, RefuseBadOptionsAndGuidesOfAnotherSize) {
  const AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, SlantedPlane);
  LocalPlaneOptions options = Window();
  options.sigma_color = 0.0;
  EXPECT_EQ(UpsampleLocalPlanes(samples, Grey(160, 120), options, {}).error().code,
            ErrorCode::kInvalidOptions);
  EXPECT_EQ(UpsampleLocalPlanes(samples, Grey(80, 120), Window(), {}).error().code,
            ErrorCode::kInvalidInput);
}

TEST(DepthMethods, AreFoundByTheirNames) {
  for (const DepthMethodInfo& info : DepthMethods()) {
    EXPECT_EQ(DepthMethodFromName(info.name).value(), info.method);
    EXPECT_TRUE(DefaultsOf(info.method).Check());
    EXPECT_EQ(DefaultsOf(info.method).method, info.method);
  }
  EXPECT_EQ(DepthMethodFromName("magic").error().code, ErrorCode::kInvalidOptions);
}

TEST(LocalPlanes, HandOutWhatAConfidenceIsComputedFrom) {
  const auto hole = [](int u, int v) { return u > 60 && u < 110 && v > 30 && v < 90 ? NAN : 1.5; };
  const AlignedSamples samples = SamplesOnLattice(160, 120, 4, 12, hole);
  const ColorImage guide = Grey(160, 120);
  SupportTermImages terms;
  LocalPlaneUpsampler upsampler(guide, Window());
  upsampler.KeepTerms(terms);
  ASSERT_TRUE(upsampler.Update(samples, {}));
  const auto without = UpsampleLocalPlanes(samples, guide, Window(), {});
  int pixels = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      ASSERT_EQ(upsampler.dense().confidence(u, v), without->confidence(u, v));
      if (std::isnan(upsampler.dense().depth_m(u, v))) continue;
      SupportTerms of_pixel;
      for (std::size_t i = 0; i < kSupportTerms; ++i) of_pixel[i] = terms[i](u, v);
      ASSERT_EQ(ShippedConfidenceWeights().Confidence(of_pixel), without->confidence(u, v));
      ++pixels;
    }
  EXPECT_GT(pixels, 10000);
  // Amid the samples, and in the hole.
  EXPECT_LT(terms[kNearestCells](30, 60), 1.0f);
  EXPECT_EQ(terms[kOneSidedRow](30, 60), 0.0f);
  EXPECT_EQ(terms[kOneSidedRow](75, 60), 1.0f);
}

}  // namespace
}  // namespace foresight
