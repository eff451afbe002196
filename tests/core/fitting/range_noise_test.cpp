#include "core/fitting/range_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/valve_rays.h"

namespace foresight {
namespace {

using samples::ValveView;

class RangeNoise : public ::testing::TestWithParam<double> {};

TEST_P(RangeNoise, IsReadOffAWall) {
  ValveView view;
  view.object = ValveView::Object::kNothing;
  view.pipe = false;
  view.view_rad = 0.5;
  view.half_angle_rad = 0.12;
  view.sigma_m = GetParam();
  // About 1200 triples tell a deviation to 4 %.
  EXPECT_NEAR(EstimateRangeSigma(MakeValveScene(view).rays) / view.sigma_m, 1.0, 0.12);
}

TEST_P(RangeNoise, IsReadOffAWheelInFrontOfItsWall) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ValveView view = samples::RandomValveView(seed);
    view.sigma_m = GetParam();
    // Round tubes and edges add a little; a fit bears a third more.
    const double ratio = EstimateRangeSigma(MakeValveScene(view).rays) / view.sigma_m;
    EXPECT_GT(ratio, 0.75) << seed;
    EXPECT_LT(ratio, 1.35) << seed;
  }
}
INSTANTIATE_TEST_SUITE_P(Millimetres, RangeNoise, ::testing::Values(0.005, 0.010, 0.020, 0.030));

TEST(RangeNoise, OfAnExactDeviceIsTheLeastThereIs) {
  ValveView view;
  view.object = ValveView::Object::kNothing;
  view.pipe = false;
  view.sigma_m = 0.0;
  EXPECT_EQ(EstimateRangeSigma(MakeValveScene(view).rays), kLeastRangeSigma_m);
}

TEST_P(RangeNoise, IsReadOffAWheelWithoutAGridToo) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ValveView view = samples::RandomValveView(seed);
    view.sigma_m = GetParam();
    RaySet cloud = MakeValveScene(view).rays;
    for (RangeRay& ray : cloud.rays) ray.cell.setConstant(-1);
    // A few hundred triples tell a deviation less well than a grid's thousand.
    const double ratio = EstimateRangeSigma(cloud) / view.sigma_m;
    EXPECT_GT(ratio, 0.75) << seed;
    EXPECT_LT(ratio, 1.5) << seed;
  }
}

TEST(RangeNoise, IsUnknownWithoutNeighbours) {
  EXPECT_TRUE(std::isnan(EstimateRangeSigma(RaySet())));
  RaySet few = MakeValveScene(ValveView()).rays;
  few.rays.resize(20);
  EXPECT_TRUE(std::isnan(EstimateRangeSigma(few)));
  for (RangeRay& ray : few.rays) ray.cell.setConstant(-1);
  EXPECT_TRUE(std::isnan(EstimateRangeSigma(few)));
}

}  // namespace
}  // namespace foresight
