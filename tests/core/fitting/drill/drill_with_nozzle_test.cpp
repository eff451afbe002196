#include "core/fitting/drill/drill_with_nozzle.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/fitting/drill/fit_drill.h"
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

TEST(DrillWithNozzle, ANozzleTakesThePlaceOfChuckAndBit) {
  for (const DrillTemplate& kind : ShippedDrillTemplates()) {
    const DrillModel drill = kind.Make(1.0, {0.0, 0.0}, 0.04);
    const auto chuck =
        std::find_if(drill.parts.begin(), drill.parts.end(),
                     [](const SolidPart& part) { return part.name == DrillTemplate::kChuck; });
    if (chuck == drill.parts.end()) continue;
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

TEST(DrillWithNozzle, ADrillIsAheadOfItsNozzle) {
  const auto found = FitDrill(MakeDrillRays({}).rays, {}, {});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(found->evidence.nozzle_margin_nats.has_value());
  EXPECT_GT(*found->evidence.nozzle_margin_nats, 4.0);
}

// A hot air tool on a battery: built as a drill is, but for what it ends in.
TEST(DrillWithNozzle, WhatEndsInANozzleIsNotConfirmed) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    DrillView view;
    view.seed = seed;
    view.shape.chuck_length_m = 0.075;
    view.shape.chuck_radius_m = 0.018;
    view.shape.bit_length_m = 0.0;
    const auto found = FitDrill(MakeDrillRays(view).rays, {}, {});
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->evidence.nozzle_margin_nats.has_value());
    EXPECT_LT(*found->evidence.nozzle_margin_nats, 4.0) << seed;
    EXPECT_NE(found->verdict.level, VerdictLevel::kConfirmed) << seed;
  }
}

}  // namespace
}  // namespace foresight
