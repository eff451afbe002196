#include "core/evaluation/stereo_testbed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/evaluation/enlarge_scene.h"

namespace foresight {
namespace {

/// A wall with disparity 10 px and a plate in front of its middle with 30 px; depth = 100 / (d +
/// 10) m.
StereoScene PlateBeforeWall() {
  StereoScene scene;
  scene.name = "plate";
  scene.right = ColorImage(200, 60, {100, 100, 100});
  scene.left_disparity = FloatImage(200, 60, 10.0f);
  for (int y = 0; y < 60; ++y)
    for (int x = 80; x < 120; ++x) scene.left_disparity(x, y) = 30.0f;
  scene.left_in_both = MaskImage(200, 60, 255);
  scene.baseline_m = 0.2;
  scene.focal_px = 500.0;
  scene.left_cx = 100.0;
  scene.right_cx = 110.0;
  scene.cy = 30.0;
  scene.disparity_offset_px = 10.0;
  return scene;
}

StereoTestbedOptions ExactTestbed() {
  StereoTestbedOptions options;
  options.noise_sigma_m = 0.0;
  return options;
}

TEST(StereoTestbed, SamplesEveryFourthColumnOfEveryTwelfthRow) {
  const auto trial = MakeStereoTrial(PlateBeforeWall(), ExactTestbed());
  ASSERT_TRUE(trial);
  EXPECT_EQ(trial->samples.lines, 5);
  EXPECT_EQ(trial->samples.beams, 50);
  EXPECT_TRUE(trial->samples.Check());
}

TEST(StereoTestbed, MovesSamplesByTheirDisparity) {
  const auto trial = MakeStereoTrial(PlateBeforeWall(), ExactTestbed());
  for (const auto& sample : trial->samples.samples) {
    const float disparity = static_cast<float>(sample.beam) * 4.0f - sample.u;
    EXPECT_NEAR(sample.depth_m, 100.0f / (disparity + 10.0f), 1e-3f);
  }
}

TEST(StereoTestbed, TheNearSurfaceHidesTheFarOneInTheTruth) {
  const DepthImage truth = WarpTruthToRight(PlateBeforeWall());
  EXPECT_NEAR(truth(60, 30), 2.5, 1e-6);  // plate: left columns 80..119 move to 50..89
  EXPECT_NEAR(truth(20, 30), 5.0, 1e-6);
  // Right of the plate nothing of the wall was seen from the left: a disocclusion.
  EXPECT_TRUE(std::isnan(truth(100, 30)));
}

TEST(StereoTestbed, ASurfaceSeenStretchedHasNoCracksInTheTruth) {
  StereoScene scene = PlateBeforeWall();
  // Disparity falls by half a pixel a column: the right view sees the wall 1.5 times as wide.
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 200; ++x)
      scene.left_disparity(x, y) = 110.0f - 0.5f * static_cast<float>(x);
  const DepthImage truth = WarpTruthToRight(scene);
  for (int u = 0; u < 180; ++u) ASSERT_FALSE(std::isnan(truth(u, 30))) << u;
  // u = x - d = 1.5 x - 110, so at u = 85 the left pixel is 130 and the disparity 45.
  EXPECT_NEAR(truth(85, 30), 100.0 / (45.0 + 10.0), 1e-5);
}

TEST(StereoTestbed, NoiseDependsOnTheSeedAlone) {
  StereoTestbedOptions options;
  const auto a = MakeStereoTrial(PlateBeforeWall(), options);
  const auto b = MakeStereoTrial(PlateBeforeWall(), options);
  options.seed = 2;
  const auto c = MakeStereoTrial(PlateBeforeWall(), options);
  EXPECT_EQ(a->samples.samples[5].depth_m, b->samples.samples[5].depth_m);
  EXPECT_NE(a->samples.samples[5].depth_m, c->samples.samples[5].depth_m);
}

TEST(EnlargeScene, KeepsDepthAndDoesNotBridgeSurfaces) {
  const StereoScene scene = PlateBeforeWall();
  const StereoScene large = EnlargeScene(scene, 4);
  EXPECT_EQ(large.right.width(), 800);
  EXPECT_NEAR(large.DepthOf(large.left_disparity(400, 100)), 2.5, 1e-6);
  for (const float disparity : large.left_disparity.values())
    ASSERT_TRUE(disparity == 40.0f || disparity == 120.0f) << disparity;
}

TEST(StereoTestbed, TheRightViewsOwnTruthIsTakenAsItIs) {
  StereoScene scene = PlateBeforeWall();
  scene.right_disparity = FloatImage(200, 60, 15.0f);
  scene.right_disparity(5, 5) = NAN;
  const auto trial = MakeStereoTrial(scene, ExactTestbed());
  ASSERT_TRUE(trial);
  // The disocclusion beside the plate, which the left view cannot know.
  EXPECT_NEAR(trial->truth_m(100, 30), 100.0 / 25.0, 1e-6);
  EXPECT_TRUE(std::isnan(trial->truth_m(5, 5)));
}

TEST(EnlargeScene, EnlargesBothViewsAlike) {
  StereoScene scene = PlateBeforeWall();
  EXPECT_TRUE(EnlargeScene(scene, 4).right_disparity.empty());
  scene.right_disparity = FloatImage(200, 60, 15.0f);
  const StereoScene large = EnlargeScene(scene, 4);
  EXPECT_NEAR(TruthOfRight(large)(799, 239), 100.0 / 25.0, 1e-6);
}

}  // namespace
}  // namespace foresight
