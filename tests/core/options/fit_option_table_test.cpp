#include "core/detection/fit_option_table.h"

#include <gmock/gmock.h>

#include "core/detection/detection_json.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A head that leans: `up` has no round numbers.
Rigid<frame::Robot, frame::Base> Leaning() {
  return {Eigen::Quaterniond(0.4, 0.5, -0.6, 0.3).normalized(), {0.1, 0.2, 0.3}};
}

TEST(FitOptionTable, OptionsOfEveryKindComeBackBitForBit) {
  for (const ObjectKind kind : kObjectKinds) {
    const FitOptions options = FitOptionsFor(kind, Leaning());
    const auto read = FitOptionsFromJson(kind, FitOptionsToJson(options));
    ASSERT_TRUE(read) << read.error().message;
    for (const Option<FitOptions>& option : FitOptionTable(kind))
      EXPECT_EQ(option.get(*read), option.get(options)) << ToString(kind) << option.info.key;
  }
}

TEST(FitOptionTable, KeepsATemplateWithItsText) {
  FitOptions options = FitOptionsFor(ObjectKind::kDrill, Leaning());
  auto& drill = std::get<FitDrillOptions>(options);
  drill.templates = {drill.templates.back()};
  ASSERT_FALSE(drill.templates.front().yaml.empty());
  const auto read = FitOptionsFromJson(ObjectKind::kDrill, FitOptionsToJson(options));
  ASSERT_TRUE(read) << read.error().message;
  const auto& templates = std::get<FitDrillOptions>(*read).templates;
  ASSERT_EQ(templates.size(), 1u);
  EXPECT_EQ(templates.front().name, drill.templates.front().name);
  EXPECT_EQ(templates.front().parts.size(), drill.templates.front().parts.size());
}

TEST(FitOptionTable, KeepsTheTerrainThatItIsComparedWith) {
  TerrainDetection last;
  TerrainSurface block;
  block.base_from_object = {Eigen::Quaterniond(0.4, 0.5, -0.6, 0.3).normalized(), {0.1, 0.2, 1.3}};
  block.size_m = {0.39, 0.19};
  last.surfaces = {block};
  last.origin.roi = ImageRoi::Rectangle(0.1, {10, 20}, {30, 40});
  FitOptions options = FitOptionsFor(ObjectKind::kTerrain, Leaning());
  std::get<FitTerrainOptions>(options).last = std::make_shared<const TerrainDetection>(last);
  const auto read = FitOptionsFromJson(ObjectKind::kTerrain, FitOptionsToJson(options));
  ASSERT_TRUE(read) << read.error().message;
  const auto& again = std::get<FitTerrainOptions>(*read).last;
  ASSERT_NE(again, nullptr);
  const auto& pose = again->surfaces.at(0).base_from_object;
  EXPECT_EQ(pose.rotation().coeffs(), block.base_from_object.rotation().coeffs());
  EXPECT_EQ(pose.translation(), block.base_from_object.translation());
}

TEST(FitOptionTable, RefusesOptionsThatContradictEachOther) {
  const auto read =
      FitOptionsFromJson(ObjectKind::kValve, R"({"min_rim_radius_m":0.2,"max_rim_radius_m":0.1})");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("rim"));
  EXPECT_FALSE(FitOptionsFromJson(ObjectKind::kTerrain, R"({"last":"{}"})"));
  EXPECT_FALSE(FitOptionsFromJson(ObjectKind::kDrill, R"({"template":"a: b"})"));
}

TEST(FitOptionTable, ARegionComesBackBitForBit) {
  const BoxRoi box{{Eigen::Quaterniond(0.4, 0.5, -0.6, 0.3).normalized(), {1.0 / 3, 0.1, 0.7}},
                   {0.1, 0.2, 1.0 / 7}};
  const auto read = RoiFromJson(RoiToJson(box));
  ASSERT_TRUE(read) << read.error().message;
  const auto& again = std::get<BoxRoi>(*read);
  EXPECT_EQ(again.base_from_box.rotation().coeffs(), box.base_from_box.rotation().coeffs());
  EXPECT_EQ(again.base_from_box.translation(), box.base_from_box.translation());
  EXPECT_EQ(again.size_m, box.size_m);
}

}  // namespace
}  // namespace foresight
