// The other world's scenes are what their headers say, and are judged by what was measured on them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/evaluation/drawn_region.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/other_terrain_scene.h"
#include "core/evaluation/other_tool.h"
#include "core/evaluation/other_wheel.h"
#include "core/geometry/angles.h"
#include "core/simulation/scene_objects.h"
#include "tests/core/evaluation/half_right_outcomes.h"

namespace foresight {
namespace {

using testing::HasSubstr;

constexpr int kWorldDrawings = 60;

/// Our own wheel, which was drawn by other code.
Shape WheelOf(const ValveModel& model) {
  ValveObject valve;
  valve.model = model;
  Scene scene;
  AddValve(valve, scene);
  return {scene.meshes.front().vertices, scene.meshes.front().triangles};
}

TEST(OtherWheels, AreMeasuredAsTheyWereBuilt) {
  for (const int spokes : {2, 3, 5, 6}) {
    ValveModel model;
    model.rim_radius_m = 0.14;
    model.spokes = spokes;
    model.dish_m = 0.03;
    const WheelMeasures measures = MeasureWheel(WheelOf(model));
    EXPECT_TRUE(measures.IsHandwheel()) << spokes;
    EXPECT_EQ(measures.spokes, spokes);
    // Radii are 1.7 mm apart, directions 1 deg; the first spoke lies along x.
    EXPECT_NEAR(measures.radius_m, 0.14, 0.002);
    EXPECT_LT(DegreesFromRadians(
                  std::abs(std::remainder(measures.first_spoke_rad, 2.0 * 3.14159265 / spokes))),
              1.0);
  }
}

TEST(OtherWheels, AThinRimInWavesIsARim) {
  OtherWheel wheel;
  wheel.spokes_rad = {0.0, 2.1, 4.2};
  wheel.rim_m = {0.009, 0.03};
  wheel.waves = 6;
  wheel.waves_m = 0.007;
  const WheelMeasures measures = MeasureWheel(ShapeOf(wheel));
  EXPECT_TRUE(measures.IsHandwheel());
  EXPECT_EQ(measures.spokes, 3);
  EXPECT_NEAR(measures.radius_m, wheel.radius_m, 0.002);
  wheel.rim_arc_rad *= 0.9;
  EXPECT_FALSE(MeasureWheel(ShapeOf(wheel)).IsHandwheel()) << "a gap is no wave";
}

TEST(OtherWheels, ADiscABarePlateAndARimAloneAreNone) {
  ValveModel disc;
  disc.spokes = 0;
  EXPECT_FALSE(MeasureWheel(WheelOf(disc)).IsHandwheel());
  EXPECT_FALSE(MeasureWheel(CylinderShape(0.15, 0.02)).IsHandwheel());
  EXPECT_FALSE(MeasureWheel(TorusShape(0.15, 0.012)).IsHandwheel());
}

TEST(OtherWheels, MostThatAreMeantAsWheelsAreAndNoneOfTheOthers) {
  int wheels = 0;
  for (std::uint64_t seed = 1; seed <= kWorldDrawings; ++seed) {
    Random random(seed);
    wheels += MeasureWheel(ShapeOf(DrawWheel(random))).IsHandwheel() ? 1 : 0;
    const OtherWheel thing = DrawRoundThing(random);
    EXPECT_FALSE(MeasureWheel(ShapeOf(thing)).IsHandwheel()) << thing.name << " of seed " << seed;
  }
  EXPECT_GE(wheels, kWorldDrawings * 8 / 10);
}

TEST(OtherTools, OurOwnDrillIsOneByItsShape) {
  for (const auto kind : {DrillShape::Kind::kBarrel, DrillShape::Kind::kBoxHead}) {
    DrillObject drill;
    drill.shape.kind = kind;
    Scene scene;
    AddDrill(drill, scene);
    OtherTool tool;
    tool.parts = scene.meshes;
    tool.grip_low_m = {0.0, 0.0, 0.08};
    tool.grip_high_m = {0.0, 0.0, 0.15};
    const ToolMeasures measures = MeasureTool(tool);
    EXPECT_TRUE(measures.IsDrill());
    EXPECT_NEAR(measures.grip_m, 0.051, 0.004);
  }
}

TEST(OtherTools, WhichOnesAreDrillsIsSaidByTheirShape) {
  int drills = 0;
  std::set<std::string> others;
  for (std::uint64_t seed = 1; seed <= kWorldDrawings; ++seed) {
    Random random(seed);
    drills += MeasureTool(DrawDrill(random)).IsDrill() ? 1 : 0;
    const OtherTool tool = DrawOtherTool(random);
    // A heat gun on a battery may be built as drills are.
    if (tool.name != "heat gun") {
      EXPECT_FALSE(MeasureTool(tool).IsDrill()) << tool.name << " of seed " << seed;
    }
    others.insert(tool.name);
  }
  EXPECT_GE(drills, kWorldDrawings * 8 / 10);
  EXPECT_GE(others.size(), 6u);
}

TEST(OtherBlocks, AreOfTheKnownSizeWithinFifteenMillimetres) {
  EXPECT_TRUE(HasBlockSize({0.397 + 0.012, 0.390 - 0.012, 0.143}));
  EXPECT_FALSE(HasBlockSize({0.397 + 0.016, 0.390, 0.143}));
}

TEST(OtherScenes, TheSameSeedGivesTheSameSceneAndBothKinds) {
  for (const std::string& kind : FitPopulationKinds()) {
    const auto population = MakeFitPopulation(kind, FitWorld::kOther);
    ASSERT_TRUE(population);
    EXPECT_EQ((*population)->World(), FitWorld::kOther);
    int positives = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const FitTrialScene scene = (*population)->MakeScene(seed);
      positives += scene.positive ? 1 : 0;
      EXPECT_TRUE(scene.world.Check());
      EXPECT_TRUE(scene.plan.Check());
      if (seed > 3) continue;
      const FitTrialScene again = (*population)->MakeScene(seed);
      ASSERT_EQ(scene.scene->meshes.size(), again.scene->meshes.size()) << kind;
      EXPECT_EQ(scene.scene->meshes.back().vertices, again.scene->meshes.back().vertices);
      EXPECT_EQ(scene.world.lidar.pulse_length_m, again.world.lidar.pulse_length_m);
    }
    EXPECT_GE(positives, 10) << kind;
    EXPECT_LT(positives, 20) << kind;
  }
}

TEST(OtherScenes, NoConstantOfTheLidarIsTheOneThatTheFitsKnow) {
  const LidarNoise ours;
  std::set<double> pulses;
  const auto population = MakeFitPopulation("valve", FitWorld::kOther);
  ASSERT_TRUE(population);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const LidarNoise lidar = (*population)->MakeScene(seed).world.lidar;
    EXPECT_NE(lidar.footprint_horizontal_rad, ours.footprint_horizontal_rad);
    EXPECT_NE(lidar.footprint_vertical_rad, ours.footprint_vertical_rad);
    EXPECT_GT(lidar.tail_degrees, 0);
    pulses.insert(lidar.pulse_length_m);
  }
  EXPECT_EQ(pulses.size(), 10u);
}

TEST(OtherScenes, AnInterruptedScanHasTheFirstLinesOnly) {
  const auto population = MakeFitPopulation("valve", FitWorld::kOther);
  ASSERT_TRUE(population);
  std::uint64_t seed = 1;
  while ((*population)->MakeScene(seed).scanned == 1.0) ++seed;
  const auto trial = MakeFitTrial(**population, seed, {}, {});
  ASSERT_TRUE(trial) << trial.error().message;
  const double lines = (trial->scene.plan.to_rad - trial->scene.plan.from_rad) /
                       trial->scene.plan.speed_rad_s / 0.025;
  EXPECT_NEAR(trial->cloud.lines, trial->scene.scanned * lines, 2.0);
}

TEST(OtherScenes, ATightBoxHoldsTheObjectAndLittleElse) {
  const auto population = MakeFitPopulation("drill", FitWorld::kOther);
  ASSERT_TRUE(population);
  std::uint64_t seed = 1;
  while ((*population)->MakeScene(seed).region != FitTrialScene::Region::kTightBox) ++seed;
  const auto trial = MakeFitTrial(**population, seed, {}, {});
  ASSERT_TRUE(trial) << trial.error().message;
  const auto* box = std::get_if<BoxRoi>(&trial->roi);
  ASSERT_NE(box, nullptr);
  int inside = 0;
  for (const Eigen::Vector3d& point : trial->scene.object_points)
    inside += box->Contains(trial->TrueBaseFromRobot() * point) ? 1 : 0;
  EXPECT_GT(inside, 0.97 * static_cast<double>(trial->scene.object_points.size()));
  EXPECT_LT(box->size_m.maxCoeff(), 0.6);
}

TEST(OtherScenes, NothingIsFittedToThem) {
  std::vector<FitOutcome> outcomes = HalfRightOutcomes();
  ASSERT_TRUE(FitVerdictModel(outcomes, OneFeature()));
  outcomes.back().world = FitWorld::kOther;
  const auto model = FitVerdictModel(outcomes, OneFeature());
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message, HasSubstr("judges only"));
}

}  // namespace
}  // namespace foresight
