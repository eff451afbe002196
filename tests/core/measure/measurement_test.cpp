#include "core/measure/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/angles.h"
#include "core/measure/measurement_json.h"

namespace foresight {
namespace {

using testing::HasSubstr;

MeasuredPoint At(double x, double y, double z, double sigma_m = 0.01) {
  MeasuredPoint point;
  point.position_m = {x, y, z};
  point.scan_uuid = "scan-1";
  point.line = 12;
  point.beam = 540;
  point.range_m = point.position_m.norm();
  point.sigma_m = sigma_m;
  point.ray = point.position_m.normalized();
  return point;
}

MeasuredPlane LevelPlane(double z) {
  MeasuredPlane plane;
  plane.plane = {Eigen::Vector3d::UnitZ(), z};
  plane.inliers = plane.points = 400;
  plane.rms_m = 0.02;
  plane.made_from = "the lowest level plane of the scan";
  return plane;
}

TEST(MeasureTest, ADistanceIsAsCertainAsItsRangesAlongIt) {
  // Both points lie on the line of sight: their noise adds up in full.
  const Measurement along =
      Measure(MeasureKind::kDistance, {At(1, 0, 0), At(3, 0, 0)}, std::nullopt).value();
  EXPECT_NEAR(along.value, 2.0, 1e-12);
  EXPECT_NEAR(along.sigma, std::sqrt(2.0) * 0.01, 1e-6);
  // Across the line of sight, far away, it hardly counts.
  const Measurement across =
      Measure(MeasureKind::kDistance, {At(10, -0.5, 0), At(10, 0.5, 0)}, std::nullopt).value();
  EXPECT_NEAR(across.value, 1.0, 1e-12);
  EXPECT_LT(across.sigma, 0.001);
  EXPECT_EQ(ValueText(along), "2.000 m ± 14 mm");
}

TEST(MeasureTest, AnAngleIsThatAtTheSecondPoint) {
  const Measurement angle =
      Measure(MeasureKind::kAngle, {At(2, 1, 0), At(2, 0, 0), At(2, 0, 1)}, std::nullopt).value();
  EXPECT_NEAR(DegreesFromRadians(angle.value), 90.0, 1e-9);
  EXPECT_THAT(ValueText(angle), HasSubstr("90.0°"));
  EXPECT_EQ(LabelPlace(angle), Eigen::Vector3d(2, 0, 0));
}

TEST(MeasureTest, WhatIsNotKnownOfARangeIsNotKnownOfTheValue) {
  const Measurement distance =
      Measure(MeasureKind::kDistance, {At(1, 0, 0), At(3, 0, 0, std::nan(""))}, std::nullopt)
          .value();
  EXPECT_TRUE(std::isnan(distance.sigma));
  EXPECT_EQ(ValueText(distance), "2.000 m");
}

TEST(MeasureTest, ADistanceFromAPlaneHasASignAndAHeightIsStraightUp) {
  const Measurement below =
      Measure(MeasureKind::kPlaneDistance, {At(1, 0, -0.25)}, LevelPlane(0.0)).value();
  EXPECT_NEAR(below.value, -0.25, 1e-12);
  // On a slope of 45 deg the way straight down is longer than the shortest.
  MeasuredPlane slope = LevelPlane(0.0);
  slope.plane.normal = Eigen::Vector3d(-1, 0, 1).normalized();
  const Measurement height = Measure(MeasureKind::kHeight, {At(1, 0, 2)}, slope).value();
  EXPECT_NEAR(height.value, 1.0, 1e-12);
  const auto lines = MeasurementLines(height);
  ASSERT_EQ(lines.size(), 2u) << "the way down, and a square on the ground";
  EXPECT_LT((lines[0].back() - Eigen::Vector3d(1, 0, 1)).norm(), 1e-12);
}

TEST(MeasureTest, TooFewPointsAMissingPlaneAndTheSamePointTwiceAreRefused) {
  EXPECT_FALSE(Measure(MeasureKind::kDistance, {At(1, 0, 0)}, std::nullopt));
  EXPECT_FALSE(Measure(MeasureKind::kHeight, {At(1, 0, 0)}, std::nullopt));
  EXPECT_FALSE(Measure(MeasureKind::kPoint, {At(1, 0, 0)}, LevelPlane(0)));
  EXPECT_THAT(
      Measure(MeasureKind::kDistance, {At(1, 0, 0), At(1, 0, 0)}, std::nullopt).error().message,
      HasSubstr("the same point was taken twice"));
}

TEST(MeasureTest, SurvivesItsJson) {
  for (const MeasureKind kind : kMeasureKinds) {
    std::vector<MeasuredPoint> points = {At(1.1, 0.2, 0.3), At(2, 1, 0), At(2, -1, 0.1)};
    points.resize(static_cast<std::size_t>(PointsOf(kind)));
    points[0].source = MeasuredPoint::Source::kDepth;
    points[0].image = 1;
    points[0].pixel = {320, 240};
    points[0].sigma_m = std::nan("");
    const Measurement before =
        Measure(kind, points, NeedsPlane(kind) ? std::optional(LevelPlane(-0.5)) : std::nullopt)
            .value();
    const auto after = MeasurementFromJson(MeasurementToJson(before));
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_EQ(after->kind, kind);
    EXPECT_EQ(after->value, before.value);
    EXPECT_EQ(MeasurementToJson(*after), MeasurementToJson(before));
    EXPECT_EQ(OriginText(after->points[0]), "depth map of image 1, pixel (320, 240)");
  }
}

TEST(MeasureTest, OneInAMapKeepsItsFrameAndTheSigmaOfItsScansPlace) {
  MeasuredPoint other = At(3, 0, 0);
  other.scan_uuid = "scan-2";
  other.placement_sigma_m = 0.02;
  const Measurement before =
      Measure(MeasureKind::kDistance, {At(1, 0, 0), other}, std::nullopt, MeasureFrame::kMap)
          .value();
  EXPECT_NEAR(before.sigma, std::sqrt(2.0 * 0.01 * 0.01 + 0.02 * 0.02), 1e-6);
  const auto after = MeasurementFromJson(MeasurementToJson(before));
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_EQ(after->frame, MeasureFrame::kMap);
  EXPECT_EQ(MeasurementToJson(*after), MeasurementToJson(before));
  EXPECT_EQ(after->sigma, before.sigma);
}

TEST(MeasureTest, OneOfAnEarlierProgramIsInTheRobotsFrame) {
  std::string json =
      MeasurementToJson(Measure(MeasureKind::kPoint, {At(1, 2, 3)}, std::nullopt).value());
  const std::string frame = "\"frame\":\"robot\",";
  ASSERT_NE(json.find(frame), std::string::npos) << json;
  json.erase(json.find(frame), frame.size());
  EXPECT_EQ(MeasurementFromJson(json)->frame, MeasureFrame::kRobot);
}

TEST(MeasureTest, JsonThatIsNoneIsRefusedInWords) {
  const auto refused = [](const std::string& json) {
    const auto measured = MeasurementFromJson(json);
    EXPECT_FALSE(measured) << json;
    return measured ? std::string() : measured.error().message;
  };
  EXPECT_THAT(refused(""), HasSubstr("measurement: "));
  EXPECT_THAT(refused("{}"), HasSubstr("measurement"));
  EXPECT_THAT(refused(R"({"measurement":"area","points":[]})"),
              HasSubstr("'area' is no kind of measurement"));
  EXPECT_THAT(refused(R"({"measurement":"point","points":[]})"), HasSubstr("takes 1 points"));
  std::string far =
      MeasurementToJson(Measure(MeasureKind::kPoint, {At(1, 2, 3)}, std::nullopt).value());
  far.replace(far.find("\"position_m\":[1.0"), 17, "\"position_m\":[1e9");
  EXPECT_THAT(refused(far), HasSubstr("position_m is not within"));
}

}  // namespace
}  // namespace foresight
