#include "core/fitting/ray_set.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/registration/recover_grid.h"

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Three returns of one line: straight ahead of the camera, far to its right, and none.
RegisteredScan ThreeBeams(const SensorRig& rig, double motor_rad) {
  RegisteredScan scan;
  scan.lines = 1;
  scan.beams = 3;
  const auto base_from_camera = rig.CameraFromBase(motor_rad).Inverse();
  scan.points = {(base_from_camera * Eigen::Vector3d(0.0, 0.0, 2.0)).cast<float>(),
                 (base_from_camera * Eigen::Vector3d(1.0, 0.0, 2.0)).cast<float>(),
                 Eigen::Vector3f::Constant(kNaN)};
  scan.range_m = {2.0f, 2.2f, kNaN};
  scan.intensity = {0.0f, 0.0f, 0.0f};
  scan.origins = {Eigen::Vector3f(0.01f, 0.02f, 0.03f)};
  return scan;
}

ImageRoi AroundTheCenter(const SensorRig& rig, double motor_rad) {
  const Eigen::Vector2d center(rig.camera.cx, rig.camera.cy);
  return ImageRoi::Rectangle(motor_rad, center - Eigen::Vector2d(20, 20),
                             center + Eigen::Vector2d(20, 20));
}

TEST(RaysFromScan, TakesTheReturnsInTheRegionFromTheLidarsOrigin) {
  const SensorRig rig = DefaultSensorRig();
  const RegisteredScan scan = ThreeBeams(rig, 0.2);
  const auto set = RaysFromScan(scan, rig, AroundTheCenter(rig, 0.2), 0.01);
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->rays.size(), 1U);
  EXPECT_LT((set->rays[0].Point() - scan.points[0].cast<double>()).norm(), 1e-6);
  EXPECT_LT((set->rays[0].origin - scan.origins[0].cast<double>()).norm(), 1e-9);
  EXPECT_LT((set->viewpoint - scan.origins[0].cast<double>()).norm(), 1e-9);
}

TEST(RaysFromScan, TheRegionBelongsToTheAngleItWasDrawnAt) {
  // Turned by 0.5 rad the same pixels look elsewhere: 1 m beside the point at 2 m.
  const SensorRig rig = DefaultSensorRig();
  const auto set = RaysFromScan(ThreeBeams(rig, 0.2), rig, AroundTheCenter(rig, 0.7), 0.01);
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, ErrorCode::kTooFewPoints);
}

TEST(RaysFromDepth, APixelsRayEndsAtItsDepth) {
  const SensorRig rig = DefaultSensorRig();
  DepthImage depth(rig.camera.width, rig.camera.height, kNaN);
  depth(700, 500) = 1.5f;
  const ImageRoi roi = ImageRoi::Rectangle(-0.3, {600, 400}, {800, 600});
  const auto set = RaysFromDepth(depth, rig, roi.motor_rad, roi, 1, 0.01, 0.02);
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->rays.size(), 1U);
  const Eigen::Vector3d in_camera = rig.CameraFromBase(-0.3) * set->rays[0].Point();
  EXPECT_NEAR(in_camera.z(), 1.5, 1e-6);  // a float's depth
  const auto pixel = rig.camera.Project(in_camera);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 700.0, 1e-6);
  EXPECT_NEAR(pixel->y(), 500.0, 1e-6);
}

TEST(RaysFromDepth, CountsNoMoreMeasurementsThanTheLidarMade) {
  const SensorRig rig = DefaultSensorRig();
  const DepthImage depth(rig.camera.width, rig.camera.height, 2.0f);
  const ImageRoi roi = ImageRoi::Rectangle(0.0, {600, 400}, {699, 499});
  const auto set = RaysFromDepth(depth, rig, roi.motor_rad, roi, 2, 0.01, 0.02);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->rays.size(), 2500U);
  EXPECT_TRUE(set->dense);
  // 100 x 100 px at 2 % are 200 measurements.
  EXPECT_NEAR(set->samples_per_ray * static_cast<double>(set->rays.size()), 200.0, 1e-9);
}

TEST(RaysFromDepth, ARegionBeyondTheImageIsCutAtItsEdge) {
  const SensorRig rig = DefaultSensorRig();
  const DepthImage depth(rig.camera.width, rig.camera.height, 2.0f);
  const auto set =
      RaysFromDepth(depth, rig, 0.0, ImageRoi::Rectangle(0.0, {-50, -50}, {9, 9}), 1, 0.01, 0.02);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->rays.size(), 100U);
}

TEST(RaysFromDepth, RefusesAMapOfAnotherSize) {
  const auto set = RaysFromDepth(DepthImage(10, 10, 1.0f), DefaultSensorRig(), 0.0,
                                 ImageRoi::Rectangle(0.0, {0, 0}, {9, 9}), 1, 0.01, 0.02);
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, ErrorCode::kInvalidInput);
}

/// A wall of points 0.01 rad apart as seen from the viewpoint, one of them not measured.
std::vector<Eigen::Vector3d> WallOfPoints(const Eigen::Vector3d& viewpoint) {
  std::vector<Eigen::Vector3d> points;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 30; ++column)
      points.push_back(viewpoint + Eigen::Vector3d(0.02 * column, 0.02 * row, 2.0));
  points[7] = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return points;
}

TEST(RaysFromCloud, TakesThePointsInTheBoxAsSeenFromTheViewpoint) {
  const Eigen::Vector3d viewpoint(0.3, -0.2, 0.1);
  const auto points = WallOfPoints(viewpoint);
  const BoxRoi box{{Eigen::Quaterniond::Identity(), viewpoint + Eigen::Vector3d(0, 0, 2.0)},
                   {0.05, 0.05, 0.1}};
  const auto set = RaysFromCloud(points, viewpoint, nullptr, box, 0.01);
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->rays.size(), 4U);
  EXPECT_EQ(set->viewpoint, viewpoint);
  EXPECT_FALSE(set->dense);
  EXPECT_LT((set->rays[1].Point() - points[1]).norm(), 1e-12);
  EXPECT_EQ(set->rays[0].cell, Eigen::Vector2i::Constant(-1));
}

TEST(RaysFromCloud, TakesWhatWentThroughTheBoxWhereItIsAskedFor) {
  const auto points = WallOfPoints(Eigen::Vector3d::Zero());
  // Half way to the wall: nothing ends in it.
  const BoxRoi box{{Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}}, {0.05, 0.05, 0.1}};
  const auto inside = RaysFromCloud(points, {0, 0, 0}, nullptr, box, 0.01);
  EXPECT_FALSE(inside);
  const auto through = RaysFromCloud(points, {0, 0, 0}, nullptr, box, 0.01, BoxRays::kPassThrough);
  ASSERT_TRUE(through) << through.error().message;
  EXPECT_EQ(through->rays.size(), 9U);  // 0, 10 and 20 mm aside there
  EXPECT_NEAR(through->rays[0].range_m, 2.0, 1e-9);
}

TEST(RaysFromCloud, KnowsHowFarApartItsRaysAreAndLeavesOutWhatWasNotMeasured) {
  const Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  const BoxRoi all{{}, Eigen::Vector3d::Constant(10.0)};
  const auto set = RaysFromCloud(WallOfPoints(viewpoint), viewpoint, nullptr, all, 0.01);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->rays.size(), 599U);
  EXPECT_NEAR(set->footprint_rad, 0.01, 0.001);  // towards the wall's ends a little less
}

TEST(RaysFromCloud, FootprintsOfAFanAreAsHighAsThoseOfAScan) {
  const Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  const BoxRoi all{{}, Eigen::Vector3d::Constant(10.0)};
  const std::vector<Eigen::Vector3d> points = WallOfPoints(viewpoint);
  GridPlaces places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    places.line.push_back(static_cast<std::int32_t>(i / 30));
    places.beam.push_back(static_cast<std::int32_t>(i % 30));
  }
  const auto height_of = [&](GridPlaces::Kind kind) {
    places.kind = kind;
    const auto set =
        RaysFromCloud(points, viewpoint, nullptr, all, 0.01, BoxRays::kEndInside, &places);
    return set.value().footprint_height_rad;
  };
  EXPECT_EQ(height_of(GridPlaces::Kind::kSweeps), 0.012);
  EXPECT_EQ(height_of(GridPlaces::Kind::kNumbers), 0.012);
  EXPECT_EQ(height_of(GridPlaces::Kind::kRings), 0.0);
  EXPECT_EQ(height_of(GridPlaces::Kind::kRows), 0.0);
}

TEST(RaysFromCloud, ARegionInAnImageNeedsTheCalibration) {
  const SensorRig rig = DefaultSensorRig();
  const auto ahead = rig.CameraFromBase(0.2).Inverse() * Eigen::Vector3d(0.0, 0.0, 2.0);
  const std::vector<Eigen::Vector3d> points = {ahead, ahead + Eigen::Vector3d(1.0, 0.0, 0.0)};
  const ImageRoi roi = AroundTheCenter(rig, 0.2);
  const auto set = RaysFromCloud(points, {0, 0, 0}, &rig, roi, 0.01);
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->rays.size(), 1U);
  const auto without = RaysFromCloud(points, {0, 0, 0}, nullptr, roi, 0.01);
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().code, ErrorCode::kInvalidInput);
}

TEST(RaysFromCloud, RefusesAViewpointThatIsNoPlaceAndAnEmptyRegion) {
  const std::vector<Eigen::Vector3d> points = {{0.0, 0.0, 2.0}};
  const BoxRoi far_away{{Eigen::Quaterniond::Identity(), {50.0, 0.0, 0.0}}, {1.0, 1.0, 1.0}};
  const Eigen::Vector3d nowhere(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  const auto refused = RaysFromCloud(points, nowhere, nullptr, far_away, 0.01);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidInput);
  const auto empty = RaysFromCloud(points, {0, 0, 0}, nullptr, far_away, 0.01);
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace foresight
