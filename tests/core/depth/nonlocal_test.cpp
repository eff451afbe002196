#include "core/depth/nonlocal.h"

#include <gtest/gtest.h>

#include "tests/support/sample_grids.h"

namespace foresight {
namespace {

/// Vertical stripes, dark and bright in turns.
ColorImage Stripes(int width, int height, int stripe_px) {
  ColorImage guide(width, height, {230, 230, 230});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (x / stripe_px % 2 == 0) guide(x, y) = {20, 20, 20};
  return guide;
}

AlignedSamples Constant(int width, int height) {
  return SamplesOnLattice(width, height, 4, 8, [](int, int) { return 1.5; });
}

TEST(UpsampleNonlocal, AConstantStaysConstant) {
  const auto dense = UpsampleNonlocal(Constant(60, 44), Stripes(60, 44, 7), {}, {});
  ASSERT_TRUE(dense) << dense.error().message;
  for (const float depth_m : dense->depth_m.values()) ASSERT_NEAR(depth_m, 1.5f, 1e-5f);
}

TEST(UpsampleNonlocal, AnEdgeOfTheGuideKeepsTwoDepthsApart) {
  const AlignedSamples samples =
      SamplesOnLattice(80, 40, 4, 8, [](int u, int) { return u < 40 ? 1.0 : 2.0; });
  const auto dense = UpsampleNonlocal(samples, Stripes(80, 40, 40), {}, {});
  ASSERT_TRUE(dense);
  // The step between the stripes weighs a ten thousandth of a step inside one.
  EXPECT_NEAR(dense->depth_m(39, 20), 1.0, 5e-3);
  EXPECT_NEAR(dense->depth_m(40, 20), 2.0, 5e-3);
}

TEST(UpsampleNonlocal, SimilarPixelsAcrossAnotherSurfaceShareTheirDepth) {
  // Bright bars, 2 px wide, in front of a dark wall; only one bar has samples of its own.
  const auto bright = [](int u) { return u / 2 % 2 == 1; };
  const AlignedSamples samples = SamplesOnLattice(34, 40, 1, 8, [&](int u, int) {
    if (bright(u)) return u == 18 || u == 19 ? 1.0 : NAN;
    return 2.0;
  });
  const auto dense = UpsampleNonlocal(samples, Stripes(34, 40, 2), {}, {});
  ASSERT_TRUE(dense);
  // A bar without samples has no other link of any weight than to its like, 4 px away; neighbours
  // alone would put it to the wall's 2 m.
  EXPECT_NEAR(dense->depth_m(14, 20), 1.0, 0.1);
  EXPECT_NEAR(dense->depth_m(22, 20), 1.0, 0.1);
  EXPECT_NEAR(dense->depth_m(16, 20), 2.0, 0.1);
}

TEST(UpsampleNonlocal, ReachesTheMinimumOfItsEnergy) {
  const AlignedSamples samples =
      SamplesOnLattice(60, 44, 4, 8, [](int u, int v) { return 2.0 + 0.01 * u - 0.004 * v; });
  NonlocalOptions patient;
  patient.iterations = 5000;
  const auto dense = UpsampleNonlocal(samples, Stripes(60, 44, 7), {}, {});
  const auto exact = UpsampleNonlocal(samples, Stripes(60, 44, 7), patient, {});
  ASSERT_TRUE(dense && exact);
  // A millimetre: a tenth of the noise of a sample.
  for (std::size_t i = 0; i < dense->depth_m.size(); ++i)
    ASSERT_NEAR(dense->depth_m.values()[i], exact->depth_m.values()[i], 1e-3f);
}

TEST(UpsampleNonlocal, OneSampleFillsTheImage) {
  const AlignedSamples samples =
      SamplesOnLattice(50, 40, 5, 5, [](int u, int v) { return u == 25 && v == 10 ? 1.7 : NAN; });
  ASSERT_EQ(samples.samples.size(), 1u);
  const auto dense = UpsampleNonlocal(samples, Stripes(50, 40, 20), {}, {});
  ASSERT_TRUE(dense);
  for (const float depth_m : dense->depth_m.values()) ASSERT_NEAR(depth_m, 1.7f, 1e-5f);
}

TEST(UpsampleNonlocal, TrustsEveryPixelAlike) {
  const auto dense = UpsampleNonlocal(Constant(60, 44), ColorImage(60, 44), {}, {});
  ASSERT_TRUE(dense);
  EXPECT_EQ(dense->confidence, FloatImage(60, 44, 1.0f));
  EXPECT_EQ(dense->max_confidence, 1.0f);
  EXPECT_FALSE(dense->has_confidence) << "the 1 is the lidar's coverage";
}

TEST(UpsampleNonlocal, DoesNotDependOnTheNumberOfThreads) {
  // More pixels than one block of the sums has.
  const AlignedSamples samples =
      SamplesOnLattice(200, 200, 4, 8, [](int u, int v) { return 2.0 + 0.01 * u - 0.004 * v; });
  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  NonlocalOptions options;
  options.iterations = 20;
  const ColorImage guide = Stripes(200, 200, 9);
  EXPECT_EQ(UpsampleNonlocal(samples, guide, options, one)->depth_m,
            UpsampleNonlocal(samples, guide, options, two)->depth_m);
}

TEST(UpsampleNonlocal, StopsWhenCancelled) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const auto dense = UpsampleNonlocal(Constant(60, 44), ColorImage(60, 44), {}, context);
  ASSERT_FALSE(dense);
  EXPECT_EQ(dense.error().code, ErrorCode::kCancelled);
}

TEST(UpsampleNonlocal, RefusesAGuideOfAnotherSize) {
  const auto dense = UpsampleNonlocal(Constant(60, 44), ColorImage(60, 45), {}, {});
  ASSERT_FALSE(dense);
  EXPECT_EQ(dense.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(dense.error().message.find("60 x 45"), std::string::npos);
}

TEST(NonlocalOptions, NamesTheMemberAtFault) {
  NonlocalOptions options;
  options.similar_pixels = 0;
  ASSERT_FALSE(options.Check());
  EXPECT_NE(options.Check().error().message.find("similar_pixels"), std::string::npos);
}

}  // namespace
}  // namespace foresight
