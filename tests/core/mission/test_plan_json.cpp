#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/plan_json.h"

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(PlanJson, EveryMemberSurvivesTheRoundTrip) {
  ScanPlan plan;
  plan.image_angles_rad = {-0.25, 0.125};
  plan.image_mode = ScanPlan::ImageMode::kStopAndShoot;
  plan.max_blur_px = 0.1;
  plan.passes = 2;
  EXPECT_EQ(PlanFromJson(PlanToJson(plan), "plan.json").value(), plan);
}

TEST(PlanJson, AnImageModeThatWasCalledPictureModeIsRead) {
  ScanPlan plan;
  plan.image_mode = ScanPlan::ImageMode::kStopAndShoot;
  std::string json = PlanToJson(plan);
  json.replace(json.find("image_mode"), 10, "picture_mode");
  EXPECT_EQ(PlanFromJson(json, "old.json").value(), plan);
}

TEST(PlanJson, APlanOfAnEarlierVersionIsOnePassOnTheFly) {
  const auto plan = PlanFromJson(
      R"({"from_rad": -0.5, "to_rad": 0.5, "speed_rad_s": 0.17, "image_angles_rad": [0],
          "exposure_s": 0.004, "gain_db": 0})",
      "old.json");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->image_mode, ScanPlan::ImageMode::kOnTheFly);
  EXPECT_EQ(plan->passes, 1);
  EXPECT_EQ(plan->max_blur_px, 0.5);
}

TEST(PlanJson, AnUnknownImageModeIsNamed) {
  std::string json = PlanToJson(ScanPlan());
  json.replace(json.find("on_the_fly"), 10, "in_flight");
  const auto plan = PlanFromJson(json, "plan.json");
  ASSERT_FALSE(plan);
  EXPECT_THAT(plan.error().message, HasSubstr("plan.json: scan plan: image mode 'in_flight'"));
}

TEST(PlanJson, WhatNoHeadExecutesIsBadDataOfTheFile) {
  for (const auto& [from, to] : {std::pair("\"passes\":1", "\"passes\":1000000000"),
                                 std::pair("\"passes\":1", "\"passes\":1e300"),
                                 std::pair("\"speed_rad_s\":0.1", "\"speed_rad_s\":1e308,\"x\":0"),
                                 std::pair("\"gain_db\":0.0", "\"gain_db\":-1e308")}) {
    std::string json = PlanToJson(ScanPlan());
    const std::size_t at = json.find(from);
    ASSERT_NE(at, std::string::npos) << from << json;
    json.replace(at, std::string(from).size(), to);
    const auto plan = PlanFromJson(json, "plan.json");
    ASSERT_FALSE(plan) << to;
    EXPECT_EQ(plan.error().code, ErrorCode::kBadData);
    EXPECT_THAT(plan.error().message, HasSubstr("plan.json: ")) << to;
  }
}

}  // namespace
}  // namespace foresight
