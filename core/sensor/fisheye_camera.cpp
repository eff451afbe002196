#include "core/sensor/fisheye_camera.h"

#include <cmath>
#include <numbers>

namespace foresight {
namespace {

/// sin(a) / a.
double Sinc(double a) {
  return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

/// r = atan2(k h, Z) / k and its derivatives, for a point at distance h from the axis.
struct Radius {
  double per_h;     ///< r / h, finite on the axis
  double by_h;      ///< dr / dh
  double by_depth;  ///< dr / dZ
  double by_k;      ///< dr / dk
};

Radius RadiusOf(double h, double depth, double k) {
  const double w = k * k * h * h;
  const double denominator = depth * depth + w;
  Radius radius{};
  radius.by_h = depth / denominator;
  radius.by_depth = -h / denominator;
  if (depth > 0.0 && w < 1e-4 * depth * depth) {
    // The closed forms cancel here: with rho = h / Z, r = rho - k^2 rho^3 / 3 + k^4 rho^5 / 5 - ...
    const double rho = h / depth;
    const double s = w / (depth * depth);
    radius.per_h = (1.0 - s / 3.0 + s * s / 5.0 - s * s * s / 7.0) / depth;
    radius.by_k = k * rho * rho * rho * (-2.0 / 3.0 + s * (4.0 / 5.0 - s * 6.0 / 7.0));
    return radius;
  }
  const double r = std::atan2(k * h, depth) / k;
  radius.per_h = r / h;
  radius.by_k = (h * depth / denominator - r) / k;
  return radius;
}

}  // namespace

Status FisheyeCamera::Check() const {
  if (width < 1 || height < 1 || width > 20000 || height > 20000)
    return Fail(ErrorCode::kInvalidOptions, "camera: image size {} x {} is not between 1 and 20000",
                width, height);
  if (!(fx > 0.0) || !(fy > 0.0) || !std::isfinite(fx) || !std::isfinite(fy))
    return Fail(ErrorCode::kInvalidOptions,
                "camera: focal lengths fx {} and fy {} must be positive", fx, fy);
  if (!std::isfinite(cx) || !std::isfinite(cy))
    return Fail(ErrorCode::kInvalidOptions, "camera: principal point ({}, {}) is not finite", cx,
                cy);
  if (!(k == 0.0 || (k > 0.05 && k < 2.0)))
    return Fail(ErrorCode::kInvalidOptions, "camera: k {} is neither 0 (pinhole) nor in (0.05, 2)",
                k);
  return {};
}

std::optional<Eigen::Vector2d> FisheyeCamera::Project(const Eigen::Vector3d& point) const {
  return Project(point, nullptr, nullptr);
}

std::optional<Eigen::Vector2d> FisheyeCamera::Project(
    const Eigen::Vector3d& point, Eigen::Matrix<double, 2, 3>* by_point,
    Eigen::Matrix<double, 2, 5>* by_parameters) const {
  if (!point.allFinite()) return std::nullopt;
  const double depth = point.z();
  if (depth <= 0.0 && k == 0.0) return std::nullopt;
  const double h = std::hypot(point.x(), point.y());
  if (h == 0.0 && depth <= 0.0) return std::nullopt;

  const Radius radius = RadiusOf(h, depth, k);
  const double x = radius.per_h * point.x();
  const double y = radius.per_h * point.y();
  if (by_point != nullptr) {
    // d(r X / h) / dX = r/h + (dr/dh - r/h) X^2 / h^2, and so on; the bracket vanishes on the axis.
    const double ux = h > 0.0 ? point.x() / h : 0.0;
    const double uy = h > 0.0 ? point.y() / h : 0.0;
    const double bend = h > 0.0 ? radius.by_h - radius.per_h : 0.0;
    *by_point << fx * (radius.per_h + bend * ux * ux), fx * bend * ux * uy,
        fx * radius.by_depth * ux, fy * bend * ux * uy, fy * (radius.per_h + bend * uy * uy),
        fy * radius.by_depth * uy;
  }
  if (by_parameters != nullptr) {
    const double ux = h > 0.0 ? point.x() / h : 0.0;
    const double uy = h > 0.0 ? point.y() / h : 0.0;
    *by_parameters << x, 0.0, 1.0, 0.0, fx * radius.by_k * ux, 0.0, y, 0.0, 1.0,
        fy * radius.by_k * uy;
  }
  return Eigen::Vector2d(fx * x + cx, fy * y + cy);
}

std::optional<Eigen::Vector3d> FisheyeCamera::Unproject(const Eigen::Vector2d& pixel) const {
  const double x = (pixel.x() - cx) / fx;
  const double y = (pixel.y() - cy) / fy;
  if (k == 0.0) return Eigen::Vector3d(x, y, 1.0).normalized();
  const double angle = k * std::hypot(x, y);
  if (!(angle < std::numbers::pi)) return std::nullopt;
  // (tan(k r) / (k r)) (x, y) and 1, multiplied through by cos(k r): no pole at 90 deg.
  const double stretch = Sinc(angle);
  return Eigen::Vector3d(stretch * x, stretch * y, std::cos(angle)).normalized();
}

std::optional<Eigen::Vector2d> FisheyeCamera::UnprojectToPlane(const Eigen::Vector2d& pixel) const {
  const auto ray = Unproject(pixel);
  if (!ray || ray->z() < 1e-6) return std::nullopt;
  return Eigen::Vector2d(ray->x() / ray->z(), ray->y() / ray->z());
}

FisheyeCamera PinholeCamera(int width, int height, double focal_px, double cx, double cy) {
  return {.width = width,
          .height = height,
          .fx = focal_px,
          .fy = focal_px,
          .cx = cx,
          .cy = cy,
          .k = 0.0};
}

}  // namespace foresight
