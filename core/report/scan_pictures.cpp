#include "core/report/scan_pictures.h"

#include <algorithm>
#include <cmath>

#include "core/detection/outline.h"
#include "core/pictures/cloud_picture.h"
#include "core/pictures/detection_picture.h"
#include "core/pictures/draw.h"
#include "core/registration/returns_in_robot.h"

namespace foresight {
namespace {

constexpr int kWidth_px = 1200, kHeight_px = 800;
constexpr double kAboveHead_m = 0.5;

/// From the 2nd to the 98th percentile.
ValueRange MostOf(std::vector<float> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) -> double {
    return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
  };
  return {at(0.02), std::max(at(0.98), at(0.02) + 0.1)};
}

struct Extent {
  ValueRange x, y, z;
  Eigen::Vector3d Middle() const {
    return 0.5 * Eigen::Vector3d(x.low + x.high, y.low + y.high, z.low + z.high);
  }
};

Extent ExtentOf(const std::vector<Eigen::Vector3f>& points) {
  const auto along = [&](int axis) {
    std::vector<float> values;
    for (const Eigen::Vector3f& point : points) values.push_back(point[axis]);
    return MostOf(std::move(values));
  };
  return {along(0), along(1), along(2)};
}

CloudView ViewOf(const Extent& extent, CloudSide side) {
  CloudView view;
  view.width = kWidth_px;
  view.height = kHeight_px;
  view.field_of_view_rad = 0.3;  // narrow: almost without perspective
  view.target = extent.Middle();
  const bool above = side == CloudSide::kAbove;
  const ValueRange& across = above ? extent.y : extent.x;
  const ValueRange& up = above ? extent.x : extent.z;
  const double ratio = static_cast<double>(kWidth_px) / kHeight_px;
  const double width_m = 1.15 * std::max(across.high - across.low, ratio * (up.high - up.low));
  const double away_m = 0.5 * width_m / std::tan(0.5 * view.field_of_view_rad);
  view.eye = view.target +
             (above ? Eigen::Vector3d(0.0, 0.0, away_m + 0.5 * (extent.z.high - extent.z.low))
                    : Eigen::Vector3d(0.0, -away_m - 0.5 * (extent.y.high - extent.y.low), 0.0));
  view.up = above ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  return view;
}

}  // namespace

ColorImage PaintScanCloud(const RegisteredScan& cloud, const SensorRig& rig,
                          const std::vector<Detection>& objects, CloudSide side) {
  std::vector<Eigen::Vector3f> points = ReturnsInRobot(cloud, rig);
  if (side == CloudSide::kAbove) {
    const double highest_m = rig.robot_from_base.translation().z() + kAboveHead_m;
    std::erase_if(points, [&](const Eigen::Vector3f& point) { return point.z() > highest_m; });
  }
  const Extent extent = ExtentOf(points);
  std::vector<ColoredPoint> colored;
  colored.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
    colored.push_back({point, ColorOf(ColorMap::kViridis, extent.z.Fraction(point.z()))});
  const CloudView view = ViewOf(extent, side);
  ColorImage picture = PaintCloud(colored, view);
  for (const Detection& object : objects)
    for (const Outline& outline : OutlinesOf(object, 0)) {
      PixelLines lines;
      for (const auto& line : WireframeInRobot(outline.lines, rig)) {
        lines.emplace_back();
        for (const Eigen::Vector3d& point : line)
          lines.back().push_back(ProjectToCloudPicture(point, view));
      }
      DrawPolylines(picture, lines, Rgb8{0, 0, 0}, 4);
      DrawPolylines(picture, lines, ColorOf(outline.level), 2);
    }
  PictureLegend legend;
  legend.bar = {ColorMap::kViridis, extent.z, "m high", false};
  return WithLegend(picture, legend);
}

ColorImage PaintObjects(ColorImage image, const std::vector<Detection>& objects,
                        const SensorRig& rig, double motor_rad) {
  for (const Detection& object : objects) DrawDetection(image, object, 0, rig, motor_rad);
  return image;
}

}  // namespace foresight
