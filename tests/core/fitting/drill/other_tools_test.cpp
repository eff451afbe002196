#include "core/fitting/drill/other_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/fitting/drill/fit_drill.h"
#include "tests/support/drill_rays.h"

namespace foresight {
namespace {

using samples::DrillView;
using samples::MakeDrillRays;

int PartsNamed(const std::string& name, const DrillModel& model) {
  return static_cast<int>(
      std::count_if(model.parts.begin(), model.parts.end(),
                    [&](const SolidPart& part) { return part.name == name; }));
}

DrillTemplate BarrelDrill() {
  std::vector<DrillTemplate> kinds = ShippedDrillTemplates();
  const auto barrel = std::find_if(kinds.begin(), kinds.end(), [](const DrillTemplate& kind) {
    return kind.name == "barrel drill";
  });
  EXPECT_NE(barrel, kinds.end());
  return *barrel;
}

TEST(OtherTools, WithoutAFootTheGripStandsOnTheTable) {
  const auto tool = WithoutFoot(BarrelDrill());
  ASSERT_TRUE(tool.has_value());
  ASSERT_TRUE(tool->Check());
  const DrillModel model = tool->Make(1.0, {0.0, 0.0}, 0.0);
  EXPECT_EQ(PartsNamed(DrillTemplate::kFoot, model), 0);
  // Just inside of the grip at the table; and 20 mm before the grip, where the battery was.
  EXPECT_LT(model.Distance({0.0, 0.0, 0.001}), 0.0);
  EXPECT_NEAR(model.Distance({0.046, 0.0, 0.010}), 0.020, 1e-6);
  // All else is the drill's.
  const DrillModel drill = BarrelDrill().Make(1.0, {0.0, 0.0}, 0.0);
  EXPECT_NEAR(model.Distance({0.0, 0.0, 0.35}), drill.Distance({0.0, 0.0, 0.35}), 1e-9);
  EXPECT_FALSE(WithoutFoot(*tool).has_value()) << "there is none to take away";
}

TEST(OtherTools, ABluntHeadGoesOnInTheChucksPlaceAndGrowsWithTheHead) {
  const auto tool = WithBluntHead(BarrelDrill());
  ASSERT_TRUE(tool.has_value());
  ASSERT_TRUE(tool->Check());
  for (const double head : {1.0, 1.2}) {
    const DrillModel model = tool->Make(1.0, {0.0, 0.0}, 0.0, {.head_fraction = head});
    EXPECT_EQ(PartsNamed(DrillTemplate::kChuck, model), 0);
    // Over the middle of where the chuck was: the head's radius is 34 mm.
    EXPECT_NEAR(model.Distance({0.115, 0.0, 0.208 + 0.050}), 0.050 - 0.88 * 0.034 * head, 1e-6);
  }
  EXPECT_FALSE(WithBluntHead(*tool).has_value()) << "there is no chuck any more";
}

TEST(OtherTools, ADrillOnItsBatteryIsAheadOfThem) {
  const auto found = FitDrill(MakeDrillRays({}).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.no_foot_margin_nats && found->evidence.no_chuck_margin_nats);
  EXPECT_GT(*found->evidence.no_foot_margin_nats, 50.0);
  EXPECT_GT(*found->evidence.no_chuck_margin_nats, 10.0);
}

// As a heat gun does: it leans, and its grip is thicker than a drill's. A drill whose foot was cut
// away in the pose of the drill was far behind it.
TEST(OtherTools, WhatStandsOnTheEndOfItsGripIsNotAheadOfIt) {
  DrillView view;
  view.shape.foot_m = {0.056, 0.056, 0.040};
  view.shape.foot_forward_m = 0.0;
  view.shape.grip_radius_m = 0.028;
  view.shape.body_tilt_rad = {0.0, 0.10};
  const auto found = FitDrill(MakeDrillRays(view).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.no_foot_margin_nats.has_value());
  EXPECT_LT(*found->evidence.no_foot_margin_nats, 10.0);
  EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed);
}

TEST(OtherTools, WhatStaysWideToItsMouthIsNotAheadOfIt) {
  DrillView view;
  view.shape.chuck_radius_m = 0.031;
  view.shape.chuck_length_m = 0.050;
  view.shape.bit_length_m = 0.0;
  const auto found = FitDrill(MakeDrillRays(view).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.no_chuck_margin_nats.has_value());
  EXPECT_LT(*found->evidence.no_chuck_margin_nats, 0.0);
  EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed);
}

}  // namespace
}  // namespace foresight
