#include "core/fitting/drill/drill_without_foot.h"

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
  return static_cast<int>(std::count_if(model.parts.begin(), model.parts.end(),
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

TEST(DrillWithoutFoot, WithoutAFootTheGripStandsOnTheTable) {
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

TEST(DrillWithoutFoot, ADrillOnItsBatteryIsAheadOfOneWithoutAFoot) {
  const auto found = FitDrill(MakeDrillRays({}).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.no_foot_margin_nats.has_value());
  EXPECT_GT(*found->evidence.no_foot_margin_nats, 50.0);
}

// As a heat gun does: it leans, and its grip is thicker than a drill's.
TEST(DrillWithoutFoot, WhatStandsOnTheEndOfItsGripIsNotAheadOfIt) {
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

}  // namespace
}  // namespace foresight
