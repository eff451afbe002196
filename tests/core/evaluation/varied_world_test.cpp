// Our own things under conditions that no fit knows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/evaluation/fit_populations.h"
#include "tests/core/evaluation/half_right_outcomes.h"

namespace foresight {
namespace {

using testing::AnyOf;

TEST(VariedScenes, HoldTheThingsOfHome) {
  for (const std::string& kind : FitPopulationKinds()) {
    const auto home = MakeFitPopulation(kind, FitWorld::kHome);
    const auto varied = MakeFitPopulation(kind, FitWorld::kVaried);
    ASSERT_TRUE(home && varied);
    EXPECT_EQ((*varied)->World(), FitWorld::kVaried);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const FitTrialScene a = (*home)->MakeScene(seed);
      const FitTrialScene b = (*varied)->MakeScene(seed);
      EXPECT_EQ(a.what, b.what);
      // But for a bar in front of it.
      const std::size_t things = a.scene->meshes.size();
      ASSERT_THAT(b.scene->meshes.size(), AnyOf(things, things + 1)) << kind;
      for (std::size_t i = 0; i < things; ++i)
        EXPECT_EQ(a.scene->meshes[i].vertices, b.scene->meshes[i].vertices);
      EXPECT_TRUE(b.world.Check());
    }
  }
}

TEST(VariedScenes, AFootprintThatIsNotOursDoesNotMakeARimDeepAndItsWheelFar) {
  // Wheels that lay 18 to 27 mm too far from the viewer, each with a rim 4 to 7 mm too deep.
  const auto varied = MakeFitPopulation("valve", FitWorld::kVaried);
  ASSERT_TRUE(varied);
  double sum_mm = 0.0;
  const std::vector<std::uint64_t> seeds = {5008, 5014, 5170, 5203};
  for (const std::uint64_t seed : seeds) {
    const auto outcomes = RunFitTrial(**varied, seed, {}, {});
    ASSERT_TRUE(outcomes) << outcomes.error().message;
    ASSERT_EQ(outcomes->size(), 1U);
    ASSERT_TRUE(outcomes->front().found) << seed;
    for (const auto& [name, error] : outcomes->front().errors)
      if (name == "along_mm") sum_mm += std::abs(error);
  }
  EXPECT_GT(sum_mm, 0.0);
  EXPECT_LT(sum_mm / static_cast<double>(seeds.size()), 17.0);
}

TEST(VariedScenes, AreMeasuredUnderDrawnConditions) {
  constexpr int kScenes = 200;
  const auto varied = MakeFitPopulation("drill", FitWorld::kVaried);
  ASSERT_TRUE(varied);
  int footprints = 0, pulses = 0, tails = 0, rigs = 0, regions = 0, interrupted = 0, occluded = 0;
  const LidarNoise ours;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    const FitTrialScene scene = (*varied)->MakeScene(seed);
    const LidarNoise& lidar = scene.world.lidar;
    footprints += lidar.footprint_vertical_rad != ours.footprint_vertical_rad ? 1 : 0;
    pulses += lidar.pulse_length_m != ours.pulse_length_m ? 1 : 0;
    tails += lidar.tail_degrees > 0 ? 1 : 0;
    rigs += scene.rig_error ? 1 : 0;
    regions += scene.region != FitTrialScene::Region::kCircle ? 1 : 0;
    interrupted += scene.scanned < 1.0 ? 1 : 0;
    occluded += scene.scene->meshes.back().name == "bar in front" ? 1 : 0;
    EXPECT_GE(lidar.footprint_vertical_rad, 0.5 * ours.footprint_vertical_rad);
    EXPECT_LE(lidar.footprint_vertical_rad, 2.0 * ours.footprint_vertical_rad);
    EXPECT_LE(lidar.sigma_base_m, 0.024);
  }
  for (const int drawn : {footprints, pulses, tails, rigs, regions})
    EXPECT_NEAR(drawn, 0.8 * kScenes, 0.1 * kScenes);
  EXPECT_NEAR(occluded, 0.4 * kScenes, 0.12 * kScenes);
  EXPECT_NEAR(interrupted, 0.1 * kScenes, 0.07 * kScenes);
}

TEST(VariedScenes, WeightsMayBeFittedToThem) {
  std::vector<FitOutcome> outcomes = HalfRightOutcomes();
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (i % 3 != 0) outcomes[i].world = FitWorld::kVaried;
  EXPECT_TRUE(FitVerdictModel(outcomes, OneFeature()));
}

TEST(VariedScenes, TheirWorldComesBackFromItsName) {
  for (const FitWorld world : {FitWorld::kHome, FitWorld::kVaried, FitWorld::kOther})
    EXPECT_EQ(FitWorldFromString(ToString(world)).value(), world);
  EXPECT_FALSE(FitWorldFromString("mars"));
}

}  // namespace
}  // namespace foresight
