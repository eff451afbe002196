// Wheels of ValvePopulation are what they are said to be, by their shape.
#include "core/evaluation/valve_population.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/evaluation/other_wheel.h"
#include "core/evaluation/varied_wheel.h"

namespace foresight {
namespace {

constexpr int kValveDrawings = 60;

ValveModel Like(std::uint64_t seed) {
  ValveModel model;
  model.rim_radius_m = 0.10 + 0.002 * static_cast<double>(seed);
  model.spokes = 2 + static_cast<int>(seed % 5);
  model.dish_m = 0.02;
  return model;
}

TEST(ValvePopulation, WheelsOfOtherSectionsAreHandwheelsByTheirShape) {
  int wheels = 0;
  for (std::uint64_t seed = 1; seed <= kValveDrawings; ++seed) {
    Random random(seed);
    const VariedWheel wheel = RandomVariedWheel(Like(seed), random);
    const WheelMeasures measures = MeasureWheel(ShapeOf(wheel));
    wheels += measures.IsHandwheel() ? 1 : 0;
    if (!measures.IsHandwheel()) continue;
    EXPECT_EQ(measures.spokes, ModelOf(wheel).spokes) << wheel.made << " of seed " << seed;
    // Rays are up to 3 mm apart, and a rim of 4 mm is seen by one or two of them.
    EXPECT_NEAR(measures.radius_m, wheel.radius_m, 0.004) << wheel.made << " of seed " << seed;
  }
  EXPECT_GE(wheels, kValveDrawings * 8 / 10);  // rays along the axis may miss thin rims
}

TEST(ValvePopulation, ThingsThatAreAlmostWheelsAreNoneByTheirShape) {
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed <= kValveDrawings; ++seed) {
    Random random(seed);
    std::string what;
    const VariedWheel thing = RandomAlmostWheel(Like(seed), random, what);
    EXPECT_FALSE(MeasureWheel(ShapeOf(thing)).IsHandwheel()) << what << " of seed " << seed;
    drawn.insert(what);
  }
  EXPECT_EQ(drawn.size(), 4U);
}

TEST(ValvePopulation, TheTruthOfAFlatWheelIsAsFlatAsItWasDrawn) {
  Random random(3);
  const VariedWheel wheel = RandomVariedWheel(Like(3), random);
  const ValveModel model = ModelOf(wheel);
  EXPECT_TRUE(model.Check());
  EXPECT_NEAR(model.RimDepth(), wheel.rim_depth_m, 1e-12);
  EXPECT_NEAR(model.SpokeDepth(), wheel.spoke_depth_m, 1e-12);
}

TEST(ValvePopulation, DrawsWheelsThatAreMadeInEachWayAndAlmostWheels) {
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    drawn.insert(ValvePopulation().MakeScene(seed).what);
  for (const char* what :
       {"wheel of", "cast wheel of", "plate wheel of", "rolled wheel of", "pressed wheel of",
        "a ring", "a cross without a rim", "a wheel that lacks a spoke", "half a flat wheel",
        "half a wheel", "a box"})
    EXPECT_TRUE(std::any_of(drawn.begin(), drawn.end(), [&](const std::string& name) {
      return name.starts_with(what);
    })) << what;
}

}  // namespace
}  // namespace foresight
