#include "core/evaluation/simulated_trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/depth/depth_method.h"
#include "core/geometry/angles.h"
#include "tests/core/simulation/small_world.h"

namespace foresight {
namespace {

constexpr const char* kMaterial = "materials:\n  a: {color: [0.5, 0.5, 0.5]}\n";
constexpr const char* kWall =
    "  - {shape: box, size_m: [0.1, 8, 8], position_m: [2.05, 0, 0], material: a}\n";

std::shared_ptr<const Scene> Wall() {
  return test::SceneOf(std::string(kMaterial) + "solids:\n" + kWall);
}

std::shared_ptr<const Scene> BoxBeforeWall() {
  return test::SceneOf(
      std::string(kMaterial) + "solids:\n" + kWall +
      "  - {shape: box, size_m: [0.2, 0.4, 0.4], position_m: [1.1, 0, 0], material: a}\n");
}

/// A quarter of the default camera's size, a second of sweep, no noise and a true calibration.
SimulatedTrialOptions Exact() {
  SimulatedTrialOptions options;
  options.plan.from_rad = RadiansFromDegrees(-20.0);
  options.plan.to_rad = RadiansFromDegrees(20.0);
  options.plan.speed_rad_s = RadiansFromDegrees(40.0);
  options.plan.image_angles_rad = {0.0};
  options.world = test::Noiseless();
  options.true_rig = test::SmallRig();
  options.true_rig.camera = {.width = 320,
                             .height = 240,
                             .fx = 150.0,
                             .fy = 150.0,
                             .cx = 159.5,
                             .cy = 119.5,
                             .lens = FisheyeLens{0.9413}};
  options.calibration_error = {0.0, 0.0};
  return options;
}

/// The truth where the camera sees a point at (0, -slope, 1) of its axes: upwards in the middle.
float TruthAtSlope(const SimulatedTrial& trial, const CameraModel& camera, double up) {
  const auto pixel = camera.Project(Eigen::Vector3d(0.0, -up, 1.0));
  return trial.truth_m(static_cast<int>(std::lround(pixel->x())),
                       static_cast<int>(std::lround(pixel->y())));
}

TEST(SimulatedTrial, WithoutNoiseAndErrorTheDepthIsTheWalls) {
  const auto trial = MakeSimulatedTrial(Wall(), Exact(), {});
  ASSERT_TRUE(trial) << trial.error().message;
  for (const DepthMethod method : {DepthMethod::kForesight, DepthMethod::kPaper}) {
    const auto score = EvaluateOnTrial(*trial, DefaultsOf(method), {});
    ASSERT_TRUE(score) << score.error().message;
    // The lidar reports whole millimetres.
    EXPECT_LT(score->with_mask.a80_mm, 0.5) << InfoOf(method).name;
    EXPECT_GT(score->with_mask.coverage, 0.9) << InfoOf(method).name;
    EXPECT_TRUE(std::isnan(score->rejection_recall)) << "a bare wall has no outliers";
  }
}

TEST(SimulatedTrial, AShiftAlongTheAxisMovesTheDepthByItsLength) {
  SimulatedTrialOptions options = Exact();
  options.plan.from_rad = RadiansFromDegrees(-5.0);
  options.plan.to_rad = RadiansFromDegrees(5.0);
  options.plan.speed_rad_s = RadiansFromDegrees(20.0);
  options.world.seed = 2;
  options.calibration_error = {0.0, 0.050};
  const Eigen::Vector3d shift =
      MiscalibratedRig(options.true_rig, options.calibration_error, options.world.seed)
          .camera_from_lidar.translation() -
      options.true_rig.camera_from_lidar.translation();
  const auto trial = MakeSimulatedTrial(Wall(), options, {});
  ASSERT_TRUE(trial);
  const auto score = EvaluateOnTrial(*trial, DefaultsOf(DepthMethod::kForesight), {});
  ASSERT_TRUE(score);
  // The wall faces the camera; a line taken at 5 deg shifts along an axis turned by as much.
  const double turned = std::sin(RadiansFromDegrees(5.0));
  EXPECT_NEAR(score->with_mask.a80_mm, 1000.0 * std::abs(shift.z()),
              1000.0 * (turned * shift.norm() + 0.001));
  EXPECT_GT(std::abs(shift.z()), 2.0 * turned * shift.norm()) << "this seed shows nothing";
}

TEST(SimulatedTrial, TheDefaultErrorMovesPointsByAtMostItsTurnAndItsShift) {
  SimulatedTrialOptions options = Exact();
  const auto exact = MakeSimulatedTrial(Wall(), options, {});
  options.calibration_error = CalibrationError();
  const auto wrong = MakeSimulatedTrial(Wall(), options, {});
  ASSERT_TRUE(exact && wrong);
  ASSERT_EQ(exact->cloud.points.size(), wrong->cloud.points.size());
  double sum2_m2 = 0.0, count = 0.0;
  for (std::size_t i = 0; i < exact->cloud.points.size(); ++i) {
    const double moved_m = (exact->cloud.points[i] - wrong->cloud.points[i]).norm();
    if (std::isnan(moved_m)) continue;
    // 0.1 deg of a range, counted from the camera that lies 72 mm beside the lidar.
    const double reach_m = 0.003 + RadiansFromDegrees(0.1) * (exact->cloud.range_m[i] + 0.072);
    ASSERT_LE(moved_m, reach_m + 1e-5);
    sum2_m2 += moved_m * moved_m;
    count += 1.0;
  }
  EXPECT_GT(std::sqrt(sum2_m2 / count), 0.002);
}

TEST(MiscalibratedRig, IsOffByExactlyTheSizesInADirectionOfTheSeed) {
  const SensorRig truth = DefaultSensorRig();
  const CalibrationError error;
  Eigen::Vector3d first_shift = Eigen::Vector3d::Zero();
  for (const std::uint64_t seed : {1, 2}) {
    const SensorRig rig = MiscalibratedRig(truth, error, seed);
    const Eigen::AngleAxisd turn(rig.camera_from_lidar.rotation() *
                                 truth.camera_from_lidar.rotation().conjugate());
    EXPECT_NEAR(turn.angle(), error.rotation_rad, 1e-9);
    const Eigen::Vector3d shift =
        rig.camera_from_lidar.translation() - truth.camera_from_lidar.translation();
    EXPECT_NEAR(shift.norm(), error.translation_m, 1e-12);
    EXPECT_GT((shift - first_shift).norm(), 1e-4);
    first_shift = shift;
  }
}

TEST(SimulatedTrial, WhatTheLidarCouldNotSeeIsNotScored) {
  const SimulatedTrialOptions options = Exact();
  const auto trial = MakeSimulatedTrial(BoxBeforeWall(), options, {});
  ASSERT_TRUE(trial) << trial.error().message;
  const CameraModel& camera = options.true_rig.camera;
  // The box's front edge is 0.165 m above and 0.96 m before the camera, which lies 70 mm above and
  // 15 mm before the lidar: of the wall, slopes of 0.172 to 0.207 are hidden from the lidar alone.
  EXPECT_NEAR(TruthAtSlope(*trial, camera, 0.15), 0.96f, 0.001f);
  EXPECT_TRUE(std::isnan(TruthAtSlope(*trial, camera, 0.19)));
  EXPECT_NEAR(TruthAtSlope(*trial, camera, 0.23), 1.96f, 0.001f);
  // Beyond the end of the sweep, 20 deg.
  EXPECT_NEAR(TruthAtSlope(*trial, camera, std::tan(RadiansFromDegrees(17.0))), 1.96f, 0.001f);
  EXPECT_TRUE(std::isnan(TruthAtSlope(*trial, camera, std::tan(RadiansFromDegrees(23.0)))));
}

TEST(SimulatedTrial, OnlyUpwardSweepsHaveATruth) {
  SimulatedTrialOptions options = Exact();
  std::swap(options.plan.from_rad, options.plan.to_rad);
  const auto trial = MakeSimulatedTrial(Wall(), options, {});
  ASSERT_FALSE(trial);
  EXPECT_EQ(trial.error().code, ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace foresight
