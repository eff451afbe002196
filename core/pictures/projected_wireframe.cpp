#include "core/pictures/projected_wireframe.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

constexpr double kLongestSegment_m = 0.01;

/// Appends the pieces of one polyline that the camera can see.
void AppendProjected(const std::vector<Eigen::Vector3d>& line_in_camera, const CameraModel& camera,
                     PixelLines* out) {
  std::vector<Eigen::Vector2d> piece;
  const auto close_piece = [&] {
    if (piece.size() > 1) out->push_back(piece);
    piece.clear();
  };
  const auto add = [&](const Eigen::Vector3d& point) {
    const auto pixel = camera.Project(point);
    if (pixel)
      piece.push_back(*pixel);
    else
      close_piece();
  };
  for (std::size_t i = 0; i < line_in_camera.size(); ++i) {
    if (i == 0) {
      add(line_in_camera[0]);
      continue;
    }
    const Eigen::Vector3d& from = line_in_camera[i - 1];
    const Eigen::Vector3d step = line_in_camera[i] - from;
    const int parts = std::max(1, static_cast<int>(std::ceil(step.norm() / kLongestSegment_m)));
    for (int part = 1; part <= parts; ++part) add(from + step * part / parts);
  }
  close_piece();
}

template <class Transform>
Wireframe Moved(Wireframe wireframe, const Transform& transform) {
  for (auto& line : wireframe)
    for (auto& point : line) point = transform * point;
  return wireframe;
}

}  // namespace

PixelLines ProjectWireframe(const Wireframe& in_base, const SensorRig& rig, double motor_rad) {
  PixelLines pixels;
  for (const auto& line : Moved(in_base, rig.CameraFromBase(motor_rad)))
    AppendProjected(line, rig.camera, &pixels);
  return pixels;
}

Wireframe WireframeInRobot(const Wireframe& in_base, const SensorRig& rig) {
  return Moved(in_base, rig.robot_from_base);
}

}  // namespace foresight
