#include "core/fitting/drill/other_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/fitting/drill/fit_drill.h"
#include "core/fitting/drill/named_part.h"
#include "tests/support/drill_rays.h"

namespace foresight {
namespace {

using samples::DrillView;
using samples::MakeDrillRays;

constexpr double kNozzle_m = 0.072;

double FrontOf(const SolidPart& part, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d half(0.0, 0.0, 0.5 * part.size_m.z());
  return std::max((part.object_from_part * half).dot(forward),
                  (part.object_from_part * Eigen::Vector3d(-half)).dot(forward));
}

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

/// It is less than `limit_nats` ahead of another tool, and not CONFIRMED.
void ExpectHeldBack(const DrillView& view, std::optional<double> DrillEvidence::*margin_nats,
                    double limit_nats) {
  const auto found = FitDrill(MakeDrillRays(view).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE((found->evidence.*margin_nats).has_value());
  EXPECT_LT(*(found->evidence.*margin_nats), limit_nats) << view.seed;
  EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed) << view.seed;
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

TEST(OtherTools, ADrillOnItsBatteryIsAheadOfOneWithoutAFoot) {
  const auto found = FitDrill(MakeDrillRays({}).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.no_foot_margin_nats.has_value());
  EXPECT_GT(*found->evidence.no_foot_margin_nats, 50.0);
}

// As a heat gun does: it leans, and its grip is thicker than a drill's.
TEST(OtherTools, WhatStandsOnTheEndOfItsGripIsNotAheadOfIt) {
  DrillView view;
  view.shape.foot_m = {0.056, 0.056, 0.040};
  view.shape.foot_forward_m = 0.0;
  view.shape.grip_radius_m = 0.028;
  view.shape.body_tilt_rad = {0.0, 0.10};
  ExpectHeldBack(view, &DrillEvidence::no_foot_margin_nats, 10.0);
}

TEST(OtherTools, WithoutAChuckTheHeadGoesOnInItsPlace) {
  const DrillTemplate kind = BarrelDrill();
  const auto tool = WithoutChuck(kind);
  ASSERT_TRUE(tool.has_value());
  ASSERT_TRUE(tool->Check());
  const DrillModel model = tool->Make(1.0, {0.0, 0.0}, 0.0);
  EXPECT_EQ(PartsNamed(DrillTemplate::kChuck, model), 0);
  EXPECT_EQ(tool->max_bit_length_m, 0.0);
  // It ends where the chuck did, as thick as the gear case (33 mm) to the end.
  EXPECT_NEAR(model.Distance({0.146, 0.0, 0.208}), 0.010, 1e-6);
  EXPECT_LT(model.Distance({0.130, 0.0, 0.238}), 0.0);
  // All else is the drill's.
  const DrillModel drill = kind.Make(1.0, {0.0, 0.0}, 0.0);
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-0.2, 0.0, 0.2), Eigen::Vector3d(0.1, 0.0, 0.0)})
    EXPECT_NEAR(model.Distance(place), drill.Distance(place), 1e-9);
  EXPECT_FALSE(WithoutChuck(*tool).has_value()) << "there is none to take away";
  for (const DrillTemplate& other : ShippedDrillTemplates()) {
    const bool ahead = other.bit_direction.x() > 0.9;
    EXPECT_EQ(WithoutChuck(other).has_value(), ahead) << other.name;
  }
}

// A lamp on a battery: its head is as wide to the end.
TEST(OtherTools, WhatIsAsWideToTheEndIsNotAheadOfAToolWithoutAChuck) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    DrillView view;
    view.seed = seed;
    view.shape.chuck_radius_m = 0.032;
    view.shape.bit_length_m = 0.0;
    ExpectHeldBack(view, &DrillEvidence::no_chuck_margin_nats, 5.0);
  }
  const auto drill = FitDrill(MakeDrillRays({}).rays, {}, {});
  ASSERT_TRUE(drill) << drill.error().message;
  ASSERT_TRUE(drill->evidence.no_chuck_margin_nats.has_value());
  EXPECT_GT(*drill->evidence.no_chuck_margin_nats, 10.0);
}

TEST(OtherTools, ANozzleTakesThePlaceOfChuckAndBit) {
  for (const DrillTemplate& kind : ShippedDrillTemplates()) {
    const DrillModel drill = kind.Make(1.0, {0.0, 0.0}, 0.04);
    const SolidPart* chuck = NamedPart(drill.parts, DrillTemplate::kChuck);
    if (chuck == nullptr) continue;
    const auto tools = WithNozzles(drill.parts, kNozzle_m);
    EXPECT_EQ(tools.size(), 4u) << kind.name;
    double farthest_m = 0.0;
    for (const std::vector<SolidPart>& tool : tools)
      for (const SolidPart& part : tool) {
        EXPECT_NE(part.name, DrillTemplate::kBit);
        EXPECT_TRUE(part.Check()) << part.name;
        if (part.name != DrillTemplate::kChuck) continue;
        EXPECT_NEAR(part.size_m.z(), kNozzle_m, 1e-12);
        EXPECT_GT(FrontOf(part, kind.bit_direction), FrontOf(*chuck, kind.bit_direction) - 1e-9);
        farthest_m = std::max(farthest_m, FrontOf(part, kind.bit_direction));
      }
    EXPECT_NEAR(farthest_m, drill.bit_tip_m.dot(kind.bit_direction), 1e-6) << kind.name;
  }
  EXPECT_TRUE(WithNozzles({}, kNozzle_m).empty());
}

TEST(OtherTools, ADrillIsAheadOfItsNozzle) {
  const auto found = FitDrill(MakeDrillRays({}).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.nozzle_margin_nats.has_value());
  EXPECT_GT(*found->evidence.nozzle_margin_nats, 4.0);
}

// A hot air tool on a battery: built as a drill is, but for what it ends in.
TEST(OtherTools, WhatEndsInANozzleIsNotConfirmed) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    DrillView view;
    view.seed = seed;
    view.shape.chuck_length_m = 0.075;
    view.shape.chuck_radius_m = 0.018;
    view.shape.bit_length_m = 0.0;
    ExpectHeldBack(view, &DrillEvidence::nozzle_margin_nats, 4.0);
  }
}

}  // namespace
}  // namespace foresight
