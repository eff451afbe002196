#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/detection/outline.h"
#include "core/pictures/color_map.h"
#include "core/pictures/depth_picture.h"
#include "core/pictures/projected_wireframe.h"
#include "tests/ui/synthetic_scan.h"
#include "ui/render/point_set.h"

namespace foresight {
namespace {

TEST(ColorMaps, TurboRunsFromBlueToRed) {
  const Rgb8 low = ColorOf(ColorMap::kTurbo, 0.1), high = ColorOf(ColorMap::kTurbo, 0.9);
  EXPECT_GT(low.b, low.r);
  EXPECT_GT(high.r, high.b);
}

TEST(ColorMaps, CividisGetsBrighterAllTheWay) {
  double last = -1.0;
  for (double x = 0.0; x <= 1.0; x += 0.05) {
    const Rgb8 color = ColorOf(ColorMap::kCividis, x);
    const double luma = 0.299 * color.r + 0.587 * color.g + 0.114 * color.b;
    EXPECT_GT(luma, last) << x;
    last = luma;
  }
}

TEST(RobustRange, IgnoresAFewOutliersAndMissingValues) {
  std::vector<float> values(1000, 0.0f);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0f + static_cast<float>(i) / 1000;
  values[3] = 500.0f;
  values[4] = std::numeric_limits<float>::quiet_NaN();
  const ValueRange range = RobustRange(values);
  EXPECT_GT(range.low, 0.99);
  EXPECT_LT(range.high, 2.01);
}

DenseDepth FlatDepth() {
  DenseDepth dense;
  dense.depth_m = DepthImage(20, 10, 2.0f);
  dense.confidence = FloatImage(20, 10, 1.0f);
  dense.max_confidence = 1.0f;
  return dense;
}

TEST(PaintDepth, AMaskedPixelIsGreyAndNeverBlack) {
  const MaskImage mask(20, 10, 0);
  const ColorImage capture = PaintDepth(FlatDepth(), &mask, DepthLayer::kDepth, {1.0, 3.0});
  for (const Rgb8& pixel : capture.values()) {
    EXPECT_GT(pixel.g, 40);
    EXPECT_LT(std::abs(pixel.r - pixel.b), 20);
  }
}

TEST(PaintDepth, AKeptPixelHasTheColourOfItsDepth) {
  const MaskImage mask(20, 10, 255);
  const ColorImage capture = PaintDepth(FlatDepth(), &mask, DepthLayer::kDepth, {1.0, 3.0});
  EXPECT_EQ(capture(5, 5), ColorOf(ColorMap::kTurbo, 128.0 / 255.0));
}

TEST(ProjectWireframe, TheRimLandsAroundTheProjectedCentre) {
  const SensorRig rig = DefaultSensorRig();
  ValveDetection valve;
  valve.best = {SyntheticValvePose(), SyntheticValve(), 0.0};
  const PixelLines lines = ProjectWireframe(OutlinesOf(valve, 0)[0].lines, rig, 0.1);
  const auto center =
      rig.camera.Project(rig.CameraFromBase(0.1) * SyntheticValvePose().translation());
  double farthest = 0.0;
  for (const auto& line : lines)
    for (const auto& pixel : line) farthest = std::max(farthest, (pixel - *center).norm());
  // 0.215 m to the outside of the rim at 1.8 m and 601 px a radian: 72 px, a little less or more
  // through the lens and the tilt.
  EXPECT_NEAR(farthest, 72.0, 7.0);
}

TEST(PointsOf, ADepthPointLiesWhereTheLidarMeasuredIt) {
  const SensorRig rig = DefaultSensorRig();
  CameraFrame frame;
  frame.image = ColorImage(rig.camera.width, rig.camera.height, {10, 20, 30});
  DepthImage depth(rig.camera.width, rig.camera.height, std::nanf(""));
  const Eigen::Vector3d in_robot(2.0, 0.1, 1.5);
  const auto in_camera = rig.CameraFromBase(0.0) * (rig.robot_from_base.Inverse() * in_robot);
  const auto pixel = *rig.camera.Project(in_camera);
  depth(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))) =
      static_cast<float>(in_camera.z());
  const PointSet set = PointsOf(depth, nullptr, frame, rig, PointColor::kImage, 1);
  ASSERT_EQ(set.points.size(), 1u);
  EXPECT_EQ(set.colors[0], (Rgb8{10, 20, 30}));
  // Half a pixel at 601 px a radian and 2 m.
  EXPECT_LT((set.points[0].cast<double>() - in_robot).norm(), 0.003);
}

}  // namespace
}  // namespace foresight
