#include "core/sensor/fisheye_lens.h"

#include <fmt/format.h>

#include <cmath>

#include "core/sensor/fisheye_rays.h"

namespace foresight {
namespace {

/// d(atan2(k h, Z) / k) / dk.
double RadiusByK(double h, double depth, double k) {
  const double w = k * k * h * h;
  if (depth > 0.0 && w < 1e-4 * depth * depth) {
    // The closed form cancels here: see AxialAngle.
    const double rho = h / depth;
    const double s = w / (depth * depth);
    return k * rho * rho * rho * (-2.0 / 3.0 + s * (4.0 / 5.0 - s * 6.0 / 7.0));
  }
  return (h * depth / (depth * depth + w) - std::atan2(k * h, depth) / k) / k;
}

}  // namespace

std::optional<ParameterFault> FisheyeLens::FindFault() const {
  if (k == 0.0 || (k > 0.05 && k < 2.0)) return std::nullopt;
  return ParameterFault{"k", fmt::format("k {} is neither 0 (pinhole) nor in (0.05, 2)", k)};
}

std::optional<Eigen::Vector2d> FisheyeLens::Project(
    const Eigen::Vector3d& point, Eigen::Matrix<double, 2, 3>* by_point,
    Eigen::Matrix<double, 2, 1>* by_parameters) const {
  const double depth = point.z();
  const double h = std::hypot(point.x(), point.y());
  if (!FisheyeRadiusPerH(k, h, depth)) return std::nullopt;
  const AxialRadius radius = AxialAngle(h, depth, k);
  if (by_point != nullptr) *by_point = ByPoint(point, h, radius);
  if (by_parameters != nullptr) {
    const double by_k = h > 0.0 ? RadiusByK(h, depth, k) / h : 0.0;
    *by_parameters << by_k * point.x(), by_k * point.y();
  }
  return Eigen::Vector2d(radius.per_h * point.x(), radius.per_h * point.y());
}

std::optional<Eigen::Vector3d> FisheyeLens::Unproject(const Eigen::Vector2d& image_point) const {
  return FisheyeRay(k, image_point.x(), image_point.y());
}

}  // namespace foresight
