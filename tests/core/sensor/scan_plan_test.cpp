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

TEST(SpatialSigma, MeetsTheTwoValuesThePaperGives) {
  EXPECT_NEAR(SpatialSigmaForDensity(0.02), 20.0, 1e-9);
  EXPECT_NEAR(SpatialSigmaForDensity(0.05), 15.0, 1e-9);
}

TEST(SpatialSigma, FallsWithDensity) {
  EXPECT_LT(SpatialSigmaForDensity(0.15), SpatialSigmaForDensity(0.05));
}

TEST(ScanPlan, RefusesAPictureOutsideTheScope) {
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
