#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/angles.h"

namespace foresight::samples {

/// A flat rectangle in base (y down, z forward); z of its frame is its normal.
struct Slab {
  Rigid<frame::Base, frame::Object> base_from_slab;
  Eigen::Vector2d size_m;
};

/// A slab at a place `ahead` of the viewer and `right` of it, `below` it, tilted about base x (away
/// from the viewer is positive) and z, turned about the vertical.
inline Slab SlabAt(double right, double below, double ahead, const Eigen::Vector2d& size_m,
                   double tilt_x_deg = 0.0, double tilt_z_deg = 0.0, double turn_deg = 0.0) {
  const Eigen::Quaterniond level(
      Eigen::AngleAxisd(RadiansFromDegrees(90.0), Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(RadiansFromDegrees(turn_deg), Eigen::Vector3d::UnitY()));
  const Eigen::Quaterniond tilt(
      Eigen::AngleAxisd(RadiansFromDegrees(tilt_x_deg), Eigen::Vector3d::UnitX()) *
      Eigen::AngleAxisd(RadiansFromDegrees(tilt_z_deg), Eigen::Vector3d::UnitZ()));
  return {{tilt * turn * level, {right, below, ahead}}, size_m};
}

inline Slab Ground(double below) {
  return SlabAt(0.0, below, 2.0, {8.0, 8.0});
}

/// What a scanner at the origin of base sees of slabs: rays every `step_deg` over 80 x 55 deg,
/// looking down by 40 deg, with noise along the ray.
inline RaySet RaysOnto(const std::vector<Slab>& slabs, double step_deg, double sigma_m,
                       std::uint64_t seed) {
  RaySet set;
  set.sigma_m = sigma_m;
  set.footprint_rad = RadiansFromDegrees(step_deg);
  Random random(seed);
  const int columns = static_cast<int>(80.0 / step_deg), rows = static_cast<int>(55.0 / step_deg);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double azimuth = RadiansFromDegrees(-40.0 + x * step_deg);
      const double down = RadiansFromDegrees(12.0 + y * step_deg);
      const Eigen::Vector3d direction(std::sin(azimuth), std::sin(down) * std::cos(azimuth),
                                      std::cos(down) * std::cos(azimuth));
      double range = std::numeric_limits<double>::infinity();
      for (const Slab& slab : slabs) {
        const auto slab_from_base = slab.base_from_slab.Inverse();
        const Eigen::Vector3d from = slab_from_base.translation();
        const Eigen::Vector3d along = slab_from_base.Rotate(direction);
        const double t = -from.z() / along.z();
        const Eigen::Vector3d at = from + t * along;
        if (t > 0.0 && t < range && std::abs(at.x()) <= 0.5 * slab.size_m.x() &&
            std::abs(at.y()) <= 0.5 * slab.size_m.y())
          range = t;
      }
      if (!std::isfinite(range)) continue;
      set.rays.push_back({Eigen::Vector3d::Zero(), direction, range + sigma_m * random.Normal(),
                          Eigen::Vector2i(x, y)});
    }
  return set;
}

}  // namespace foresight::samples
