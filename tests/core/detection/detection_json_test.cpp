#include "core/detection/detection_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace foresight {
namespace {

ValveDetection Sample() {
  ValveDetection detection;
  detection.best = {{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, -0.2, 1.3}},
                    {0.12, 0.013, 4, 0.009, 0.024, 0.031},
                    1234.5};
  detection.phase_observable = false;
  detection.sigma_position_m = {0.001, 0.002, 0.003};
  detection.sigma_axis_rad = 0.01;
  detection.sigma_phase_rad = 0.02;
  detection.evidence = {900, 200, 0.9, 0.03, 0.02, 0.006, 0.95, 88.0, 700.0};
  detection.verdict = {VerdictLevel::kLikely, 0.83, "only 58 % of the rim is seen", {}};
  detection.rivals = {detection.best};
  detection.rivals[0].model.spokes = 2;
  detection.origin.roi = ImageRoi::Rectangle(0.25, {10.0, 20.0}, {30.5, 40.0});
  detection.origin.seconds = 0.4;
  return detection;
}

TEST(DetectionJson, SurvivesTheRoundTrip) {
  const ValveDetection sample = Sample();
  const auto read = ValveDetectionFromJson(DetectionToJson(sample, {}));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->best.base_from_object.Matrix() == sample.best.base_from_object.Matrix());
  EXPECT_EQ(read->best.model.spokes, 4);
  EXPECT_EQ(read->best.model.dish_m, sample.best.model.dish_m);
  EXPECT_FALSE(read->phase_observable);
  EXPECT_EQ(read->sigma_position_m, sample.sigma_position_m);
  EXPECT_EQ(read->evidence.hits, 200);
  EXPECT_EQ(read->evidence.gain_nats, 700.0);
  EXPECT_EQ(read->verdict.level, VerdictLevel::kLikely);
  EXPECT_EQ(read->verdict.reason, sample.verdict.reason);
  ASSERT_EQ(read->rivals.size(), 1U);
  EXPECT_EQ(read->rivals[0].model.spokes, 2);
  EXPECT_EQ(std::get<ImageRoi>(read->origin.roi).polygon,
            std::get<ImageRoi>(sample.origin.roi).polygon);
  // And the text itself is stable.
  EXPECT_EQ(DetectionToJson(*read, {}), DetectionToJson(sample, {}));
}

TEST(DetectionJson, TellsThePoseInTheRobotsFrameToo) {
  const Rigid<frame::Robot, frame::Base> mounted(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5});
  const std::string text = DetectionToJson(Sample(), mounted);
  EXPECT_NE(text.find("robot_from_object"), std::string::npos);
  EXPECT_NE(text.find("2.8"), std::string::npos);  // 1.3 + 1.5 along z
}

TEST(DetectionJson, AnUnknownLikelihoodStaysUnknown) {
  ValveDetection sample = Sample();
  sample.evidence.margin_nats = std::numeric_limits<double>::quiet_NaN();
  const auto read = ValveDetectionFromJson(DetectionToJson(sample, {}));
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(read->evidence.margin_nats));
}

TEST(DetectionJson, RefusesDamagedText) {
  const std::string whole = DetectionToJson(Sample(), {});
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{\"kind\": \"valve\"}"),
        whole.substr(0, whole.size() / 2)}) {
    const auto read = ValveDetectionFromJson(text);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  }
}

}  // namespace
}  // namespace foresight
