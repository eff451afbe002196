#pragma once

#include <Eigen/Core>
#include <cmath>

namespace foresight {

/// A quantity that a lens, symmetric about its axis, makes of a point at the distance h from the
/// axis and the depth Z: the radius of its image, with derivatives.
struct AxialRadius {
  double per_h;     ///< r / h, finite on the axis
  double by_h;      ///< dr / dh
  double by_depth;  ///< dr / dZ
};

/// atan2(k h, Z) / k: with k = 1 the angle from the axis. k = 0 is h / Z. The point is neither the
/// origin nor on the backward axis.
inline AxialRadius AxialAngle(double h, double depth, double k) {
  const double w = k * k * h * h;
  const double denominator = depth * depth + w;
  AxialRadius radius{};
  radius.by_h = depth / denominator;
  radius.by_depth = -h / denominator;
  if (depth > 0.0 && w < 1e-4 * depth * depth) {
    // The closed form cancels here: with rho = h / Z, r = rho - k^2 rho^3 / 3 + k^4 rho^5 / 5 - ...
    const double s = w / (depth * depth);
    radius.per_h = (1.0 - s / 3.0 + s * s / 5.0 - s * s * s / 7.0) / depth;
  } else {
    radius.per_h = std::atan2(k * h, depth) / k / h;
  }
  return radius;
}

/// The derivatives of (r X / h, r Y / h) by X, Y, Z.
inline Eigen::Matrix<double, 2, 3> ByPoint(const Eigen::Vector3d& point, double h,
                                           const AxialRadius& r) {
  // d(r X / h) / dX = r/h + (dr/dh - r/h) X^2 / h^2, and so on; the bracket vanishes on the axis.
  const double ux = h > 0.0 ? point.x() / h : 0.0;
  const double uy = h > 0.0 ? point.y() / h : 0.0;
  const double bend = h > 0.0 ? r.by_h - r.per_h : 0.0;
  Eigen::Matrix<double, 2, 3> derivatives;
  derivatives << r.per_h + bend * ux * ux, bend * ux * uy, r.by_depth * ux,  //
      bend * ux * uy, r.per_h + bend * uy * uy, r.by_depth * uy;
  return derivatives;
}

}  // namespace foresight
