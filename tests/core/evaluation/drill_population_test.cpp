// What stands on the tables of DrillPopulation is what it is said to be, by its shape.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "core/detection/fit_in_scan.h"
#include "core/evaluation/drill_population.h"
#include "core/evaluation/other_tool.h"
#include "core/evaluation/table_tools.h"
#include "core/evaluation/varied_drill.h"
#include "core/evaluation/varied_world.h"

namespace foresight {
namespace {

constexpr int kDrawings = 60;

/// As other_tool.h measures it; the grip is upright in the place's frame.
OtherTool ToolOf(const Scene& scene, double lean_rad) {
  OtherTool tool;
  tool.parts = scene.meshes;
  tool.grip_low_m = {0.08 * std::tan(lean_rad), 0.0, 0.08};
  tool.grip_high_m = {0.15 * std::tan(lean_rad), 0.0, 0.15};
  return tool;
}

TEST(DrillPopulation, DrillsOfOtherProportionsAreDrillsByTheirShape) {
  int drills = 0;
  for (std::uint64_t seed = 1; seed <= kDrawings; ++seed) {
    Random random(seed);
    Scene scene;
    AddVariedDrill(RandomVariedDrill(random), {}, {}, scene);
    ASSERT_EQ(scene.drills.size(), 1u);
    drills += MeasureTool(ToolOf(scene, scene.drills.front().body_tilt_rad.y())).IsDrill() ? 1 : 0;
  }
  EXPECT_GE(drills, kDrawings * 8 / 10);
}

TEST(DrillPopulation, ToolsThatAreNegativesAreNoDrillsByTheirShape) {
  for (const TableTool kind : TableTools())
    for (std::uint64_t seed = 1; seed <= kDrawings; ++seed) {
      Random random(seed);
      Scene scene;
      AddTableTool(kind, {}, {}, random, scene);
      const ToolMeasures measures = MeasureTool(ToolOf(scene, 0.0));
      EXPECT_FALSE(measures.IsDrill()) << NameOf(kind) << " of seed " << seed;
      EXPECT_GT(measures.height_m, 0.03) << NameOf(kind) << " of seed " << seed;
      EXPECT_LT(measures.height_m, 0.35) << NameOf(kind) << " of seed " << seed;
    }
}

TEST(DrillPopulation, ShowsEveryToolAndDrillsOfOtherProportions) {
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed <= 600; ++seed)
    drawn.insert(DrillPopulation().MakeScene(seed).what);
  EXPECT_TRUE(drawn.contains("drill of other proportions"));
  for (const TableTool kind : TableTools()) EXPECT_TRUE(drawn.contains(NameOf(kind)));
}

// A blower and a trigger sprayer that were CONFIRMED as drills.
TEST(DrillPopulation, ToolsThatCameNearestAreNotConfirmed) {
  for (const std::uint64_t seed : {33u, 424u}) {
    const auto outcomes = RunFitTrial(DrillPopulation(), seed, {}, {});
    ASSERT_TRUE(outcomes) << seed << ": " << outcomes.error().message;
    EXPECT_FALSE(outcomes->front().positive) << seed;
    EXPECT_NE(outcomes->front().verdict.level, VerdictLevel::kConfirmed)
        << outcomes->front().what << " of seed " << seed;
  }
}

// Of both a region shows the end alone. Of one that was enough to tell where the drill is, the
// other was taken for one that points the other way.
TEST(DrillPopulation, HalfADrillThatTellsTheWholeIsSomethingToFind) {
  const auto right = RunFitTrial(DrillPopulation(), 1517, {}, {});
  const auto turned = RunFitTrial(DrillPopulation(), 578, {}, {});
  ASSERT_TRUE(right && turned);
  for (const auto* outcomes : {&right, &turned}) {
    EXPECT_EQ((*outcomes)->front().what, "a drill's end");
    EXPECT_TRUE((*outcomes)->front().found);
  }
  EXPECT_TRUE(right->front().all_ok);
  EXPECT_TRUE(right->front().positive);
  EXPECT_FALSE(turned->front().all_ok);
  EXPECT_FALSE(turned->front().positive);
}

// The search had climbed with another template, turned round, and never tried the drill's own.
TEST(DrillPopulation, EveryTemplateIsTriedEitherWayRound) {
  FitTrialOptions options;
  options.sources = {*FitSourceFromName("foresight")};
  const auto population = MakeVaried(std::make_unique<DrillPopulation>());
  const auto outcomes = RunFitTrial(*population, 5022, options, {});
  ASSERT_TRUE(outcomes) << outcomes.error().message;
  EXPECT_TRUE(outcomes->front().all_ok);
}

}  // namespace
}  // namespace foresight
