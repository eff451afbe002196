#include "ui/render/point_set.h"

#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/pictures/color_map.h"

namespace foresight {
namespace {

/// The same shuffle every time: an image of the same data is the same image.
template <class T>
void Reorder(std::vector<T>* values, const std::vector<int>& order) {
  if (values->empty()) return;
  std::vector<T> reordered;
  reordered.reserve(values->size());
  for (const int index : order) reordered.push_back((*values)[static_cast<std::size_t>(index)]);
  *values = std::move(reordered);
}

void Shuffle(PointSet* set) {
  std::vector<int> order(set->points.size());
  std::iota(order.begin(), order.end(), 0);
  Random random(1);
  for (int i = static_cast<int>(order.size()) - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)],
              order[static_cast<std::size_t>(random.Index(i + 1))]);
  Reorder(&set->points, order);
  Reorder(&set->values, order);
  Reorder(&set->colors, order);
}

}  // namespace

PointSet PointsOf(const RegisteredScan& scan, const SensorRig& rig, PointColor color) {
  PointSet set;
  const Eigen::Matrix3f rotation = rig.robot_from_base.RotationMatrix().cast<float>();
  const Eigen::Vector3f translation = rig.robot_from_base.translation().cast<float>();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!scan.points[i].allFinite()) continue;
    const Eigen::Vector3f point = rotation * scan.points[i] + translation;
    set.points.push_back(point);
    if (color == PointColor::kRange)
      set.values.push_back(scan.range_m[i]);
    else if (color == PointColor::kIntensity)
      set.values.push_back(scan.intensity[i]);
    else
      set.values.push_back(point.z());
  }
  if (!scan.origins.empty())
    set.viewpoint = rotation * scan.origins[scan.origins.size() / 2] + translation;
  Shuffle(&set);
  return set;
}

PointSet PointsOf(std::vector<Eigen::Vector3f> points, std::vector<float> values,
                  const Eigen::Vector3f& viewpoint) {
  PointSet set;
  set.points = std::move(points);
  set.values = std::move(values);
  set.viewpoint = viewpoint;
  Shuffle(&set);
  return set;
}

PointSet PointsOf(const std::vector<Residual>& residuals, const SensorRig& rig) {
  PointSet set;
  for (const Residual& residual : residuals) {
    set.points.push_back((rig.robot_from_base * residual.point).cast<float>());
    set.colors.push_back(
        ColorOf(ColorMap::kBalance, 0.5 + 0.5 * residual.ahead_m / kFullResidual_m));
  }
  return set;
}

PointSet PointsOf(const DepthImage& depth_m, const MaskImage* mask, const CameraFrame& capture,
                  const SensorRig& rig, PointColor color, int stride) {
  PointSet set;
  const auto robot_from_camera =
      rig.robot_from_base * rig.CameraFromBase(capture.motor_angle_rad).Inverse();
  for (int v = 0; v < depth_m.height(); v += stride) {
    for (int u = 0; u < depth_m.width(); u += stride) {
      const double depth = depth_m(u, v);
      if (!std::isfinite(depth) || (mask != nullptr && (*mask)(u, v) == 0)) continue;
      const auto slope = rig.camera.UnprojectToPlane({u, v});
      if (!slope) continue;
      const Eigen::Vector3d in_camera(slope->x() * depth, slope->y() * depth, depth);
      const Eigen::Vector3d in_robot = robot_from_camera * in_camera;
      set.points.push_back(in_robot.cast<float>());
      if (color == PointColor::kHeight)
        set.values.push_back(static_cast<float>(in_robot.z()));
      else if (color == PointColor::kRange)
        set.values.push_back(static_cast<float>(in_camera.norm()));
      else
        set.colors.push_back(capture.image(u, v));
    }
  }
  set.viewpoint = robot_from_camera.translation().cast<float>();
  Shuffle(&set);
  return set;
}

}  // namespace foresight
