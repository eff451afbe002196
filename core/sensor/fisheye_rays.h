#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/sensor/axial_angle.h"

// The paper's lens where loops over all pixels can have it inlined; fisheye_lens.h is its contract.
namespace foresight {

/// sin(a) / a.
inline double Sinc(double a) {
  return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

/// r / h of AxialAngle; nullopt where the lens shows nothing.
inline std::optional<double> FisheyeRadiusPerH(double k, double h, double depth) {
  if (depth <= 0.0 && (k == 0.0 || h == 0.0)) return std::nullopt;
  return AxialAngle(h, depth, k).per_h;
}

inline std::optional<Eigen::Vector3d> FisheyeRay(double k, double x, double y) {
  if (k == 0.0) return Eigen::Vector3d(x, y, 1.0).normalized();
  const double angle = k * std::hypot(x, y);
  if (!(angle < std::numbers::pi)) return std::nullopt;
  // (tan(k r) / (k r)) (x, y) and 1, multiplied through by cos(k r): no pole at 90 deg.
  const double stretch = Sinc(angle);
  return Eigen::Vector3d(stretch * x, stretch * y, std::cos(angle)).normalized();
}

}  // namespace foresight
