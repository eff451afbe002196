#include "core/sensor/scan_plan.h"

#include <gtest/gtest.h>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

TEST(PredictScan, CountsTheLinesOfASweep) {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-30);
  plan.to_rad = RadiansFromDegrees(80);
  const auto prediction = PredictScan(plan, DefaultSensorRig());
  ASSERT_TRUE(prediction);
  // 110 deg at 10 deg/s are 11 s, at 40 lines a second 440 lines.
  EXPECT_NEAR(prediction->duration_s, 11.0, 1e-9);
  EXPECT_NEAR(prediction->lines, 440, 1);
}

TEST(PredictScan, DensityHalvesWhenTheSpeedDoubles) {
  ScanPlan plan;
  plan.speed_rad_s = RadiansFromDegrees(20);
  const double slow = PredictScan(plan, DefaultSensorRig())->density;
  plan.speed_rad_s = RadiansFromDegrees(40);
  EXPECT_NEAR(PredictScan(plan, DefaultSensorRig())->density, slow / 2, 1e-9);
}

TEST(PredictScan, AtTheFastestSpeedTheDensityIsAtItsFloor) {
  SensorRig rig = DefaultSensorRig();
  rig.camera.fx = rig.camera.fy = 1000.0;
  ScanPlan plan;
  for (const int passes : {1, 2}) {
    plan.passes = passes;
    plan.speed_rad_s = PredictScan(plan, rig)->fastest_speed_rad_s;
    EXPECT_NEAR(PredictScan(plan, rig)->density, ScanPrediction::kMinDensity, 1e-9);
  }
}

TEST(PredictScan, TheFastestSpeedIsOneThatTheHeadCanDo) {
  ScanPlan plan;
  plan.passes = 2;
  EXPECT_EQ(PredictScan(plan, DefaultSensorRig())->fastest_speed_rad_s, ScanPlan::kMaxSpeed_rad_s);
}

TEST(PredictScan, ASecondPassDoublesLinesAndDensity) {
  ScanPlan plan;
  plan.speed_rad_s = RadiansFromDegrees(20);
  const auto once = PredictScan(plan, DefaultSensorRig());
  plan.passes = 2;
  const auto twice = PredictScan(plan, DefaultSensorRig());
  EXPECT_EQ(twice->lines, 2 * once->lines);
  EXPECT_NEAR(twice->density, 2.0 * once->density, 1e-9);
  EXPECT_GT(twice->duration_s, 2.0 * once->duration_s) << "the turn takes its time";
  EXPECT_LT(twice->sigma_spatial_px, once->sigma_spatial_px);
}

TEST(PredictScan, TheBlurBoundCapsTheExposureOnlyOnTheFly) {
  ScanPlan plan;
  plan.exposure_s = 0.02;
  const auto moving = PredictScan(plan, DefaultSensorRig());
  EXPECT_NEAR(moving->blur_px, 0.5, 1e-9);
  EXPECT_LT(moving->exposure_s, 0.005);
  plan.image_mode = ScanPlan::ImageMode::kStopAndShoot;
  const auto standing = PredictScan(plan, DefaultSensorRig());
  EXPECT_EQ(standing->exposure_s, 0.02);
  EXPECT_EQ(standing->blur_px, 0.0);
  EXPECT_GT(standing->duration_s, moving->duration_s);
}

TEST(ScanPlan, RefusesABlurBoundOfZeroAndAThirdPass) {
  ScanPlan plan;
  plan.max_blur_px = 0.0;
  EXPECT_EQ(plan.Check().error().message, "scan plan: max_blur_px 0 is not in (0, 100]");
  plan = {};
  plan.passes = 3;
  EXPECT_EQ(plan.Check().error().message, "scan plan: passes 3 is neither 1 nor 2");
}

TEST(SpatialSigma, MeetsTheTwoValuesThePaperGives) {
  EXPECT_NEAR(SpatialSigmaForDensity(0.02), 20.0, 1e-9);
  EXPECT_NEAR(SpatialSigmaForDensity(0.05), 15.0, 1e-9);
}

TEST(SpatialSigma, FallsWithDensity) {
  EXPECT_LT(SpatialSigmaForDensity(0.15), SpatialSigmaForDensity(0.05));
}

TEST(ScanPlan, RefusesAnImageOutsideTheScope) {
  ScanPlan plan;
  plan.image_angles_rad = {RadiansFromDegrees(45)};
  EXPECT_EQ(plan.Check().error().code, ErrorCode::kInvalidOptions);
}

TEST(ScanPlan, RefusesAnEmptyScopeAndAnImpossibleSpeed) {
  ScanPlan plan;
  plan.to_rad = plan.from_rad;
  EXPECT_FALSE(plan.Check());
  plan = {};
  plan.speed_rad_s = 0.0;
  EXPECT_FALSE(plan.Check());
}

TEST(ScanPlan, MaySweepDownwards) {
  ScanPlan plan;
  std::swap(plan.from_rad, plan.to_rad);
  EXPECT_TRUE(plan.Check());
}

}  // namespace
}  // namespace foresight
