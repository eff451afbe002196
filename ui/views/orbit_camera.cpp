#include "ui/views/orbit_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

constexpr double kSteepest_rad = 1.55;  // short of the pole, where "up" would turn over

}  // namespace

Eigen::Vector3d OrbitCamera::Position() const {
  const Eigen::Vector3d direction(-std::cos(elevation_rad) * std::cos(azimuth_rad),
                                  -std::cos(elevation_rad) * std::sin(azimuth_rad),
                                  std::sin(elevation_rad));
  return focal + distance_m * direction;
}

void OrbitCamera::Orbit(double by_azimuth_rad, double by_elevation_rad) {
  azimuth_rad += by_azimuth_rad;
  elevation_rad = std::clamp(elevation_rad + by_elevation_rad, -kSteepest_rad, kSteepest_rad);
}

void OrbitCamera::Zoom(double factor) {
  distance_m = std::clamp(distance_m * factor, 0.05, 100.0);
}

void OrbitCamera::Pan(double right_m, double up_m) {
  const Eigen::Vector3d forward = (focal - Position()).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  focal += right_m * right + up_m * right.cross(forward);
}

}  // namespace foresight
