#include "core/pictures/cloud_picture.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace foresight {
namespace {

constexpr double kNear_m = 0.05;

/// Rows: right, down, forward.
Eigen::Matrix3d EyeFromWorld(const CloudView& view) {
  const Eigen::Vector3d forward = (view.target - view.eye).normalized();
  const Eigen::Vector3d right = forward.cross(view.up).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = right;
  rotation.row(1) = forward.cross(right);
  rotation.row(2) = forward;
  return rotation;
}

double Focal(const CloudView& view) {
  return 0.5 * view.width / std::tan(0.5 * view.field_of_view_rad);
}

}  // namespace

Eigen::Vector2d ProjectToCloudPicture(const Eigen::Vector3d& point, const CloudView& view) {
  const Eigen::Vector3d seen = EyeFromWorld(view) * (point - view.eye);
  if (seen.z() < kNear_m)
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {0.5 * view.width + Focal(view) * seen.x() / seen.z(),
          0.5 * view.height + Focal(view) * seen.y() / seen.z()};
}

ColorImage PaintCloud(std::span<const ColoredPoint> points, const CloudView& view) {
  ColorImage picture(view.width, view.height, {24, 26, 30});
  FloatImage nearest(view.width, view.height, std::numeric_limits<float>::infinity());
  const Eigen::Matrix3d rotation = EyeFromWorld(view);
  const double focal = Focal(view);
  for (const ColoredPoint& point : points) {
    const Eigen::Vector3d seen = rotation * (point.position.cast<double>() - view.eye);
    if (!(seen.z() >= kNear_m)) continue;
    const auto x = static_cast<int>(std::floor(0.5 * view.width + focal * seen.x() / seen.z()));
    const auto y = static_cast<int>(std::floor(0.5 * view.height + focal * seen.y() / seen.z()));
    const auto depth = static_cast<float>(seen.z());
    for (int dy = 0; dy <= 1; ++dy)
      for (int dx = 0; dx <= 1; ++dx) {
        if (!picture.Contains(x + dx, y + dy) || !(depth < nearest(x + dx, y + dy))) continue;
        nearest(x + dx, y + dy) = depth;
        picture(x + dx, y + dy) = point.color;
      }
  }
  return picture;
}

}  // namespace foresight
