#include "core/sensor/radial_tangential_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/sensor/growing_function.h"
#include "core/sensor/polynomial.h"

namespace foresight {
namespace {

constexpr double kLargestRadial = 1e6;
constexpr double kLargestTangential = 1.0;
/// 1e-6 rad from the image plane: no lens without a bend sees farther.
constexpr double kLargestSlope = 1e6;

/// The distortion is the gradient of a potential, so its derivative J by (x, y) is symmetric. Where
/// J is positive definite on a disc the distortion is injective there. With P = |(p1, p2)|, along
/// and across the radius J is diag(d(r R)/dr, R) plus a matrix whose eigenvalues lie within 6 P r
/// and 2 P r of 0; it stays positive definite as long as d(r R)/dr > 6 P r and R > 10/3 P r.
double MaxSlope(double k1, double k2, double p1, double p2, double k3) {
  const double tangential = std::hypot(p1, p2);
  const std::array<double, 7> growth = {1.0, -6.0 * tangential, 3.0 * k1, 0.0, 5.0 * k2,
                                        0.0, 7.0 * k3};
  const std::array<double, 7> stretch = {1.0, -10.0 / 3.0 * tangential, k1, 0.0, k2, 0.0, k3};
  for (const double c : growth)
    if (!std::isfinite(c)) return 0.0;
  double limit = kLargestSlope;
  for (const auto& polynomial : {growth, stretch})
    if (const auto ends = SignChanges(polynomial, limit); !ends.empty()) limit = ends.front();
  return limit;
}

/// The x with a x = b, by Cramer's rule.
Eigen::Vector2d Solve(const Eigen::Matrix2d& a, const Eigen::Vector2d& b) {
  const double determinant = a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
  return Eigen::Vector2d(a(1, 1) * b.x() - a(0, 1) * b.y(), a(0, 0) * b.y() - a(1, 0) * b.x()) /
         determinant;
}

}  // namespace

RadialTangentialLens::RadialTangentialLens(double k1, double k2, double p1, double p2, double k3)
    : k1_(k1), k2_(k2), p1_(p1), p2_(p2), k3_(k3), max_slope_(MaxSlope(k1, k2, p1, p2, k3)) {}

std::optional<ParameterFault> RadialTangentialLens::FindFault() const {
  const std::array<double, 5> values = Parameters();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool tangential = kParameters[i].front() == 'p';
    const double largest = tangential ? kLargestTangential : kLargestRadial;
    if (!(std::abs(values[i]) <= largest))
      return ParameterFault{kParameters[i],
                            fmt::format("{} {} is not between {} and {}", kParameters[i], values[i],
                                        tangential ? "-1" : "-1e6", tangential ? "1" : "1e6")};
  }
  return std::nullopt;
}

Eigen::Vector2d RadialTangentialLens::Distorted(const Eigen::Vector2d& slope) const {
  const double x = slope.x(), y = slope.y();
  const double s = x * x + y * y;
  const double radial = 1.0 + s * (k1_ + s * (k2_ + s * k3_));
  return {x * radial + 2.0 * p1_ * x * y + p2_ * (s + 2.0 * x * x),
          y * radial + p1_ * (s + 2.0 * y * y) + 2.0 * p2_ * x * y};
}

Eigen::Matrix2d RadialTangentialLens::BySlope(const Eigen::Vector2d& slope) const {
  const double x = slope.x(), y = slope.y();
  const double s = x * x + y * y;
  const double radial = 1.0 + s * (k1_ + s * (k2_ + s * k3_));
  const double radial_by_s = k1_ + s * (2.0 * k2_ + s * 3.0 * k3_);
  const double mixed = 2.0 * (x * y * radial_by_s + p1_ * x + p2_ * y);
  Eigen::Matrix2d derivative;
  derivative << radial + 2.0 * x * x * radial_by_s + 2.0 * p1_ * y + 6.0 * p2_ * x, mixed,  //
      mixed, radial + 2.0 * y * y * radial_by_s + 6.0 * p1_ * y + 2.0 * p2_ * x;
  return derivative;
}

std::optional<Eigen::Vector2d> RadialTangentialLens::Project(
    const Eigen::Vector3d& point, Eigen::Matrix<double, 2, 3>* by_point,
    Eigen::Matrix<double, 2, 5>* by_parameters) const {
  if (!(point.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d slope = point.head<2>() / point.z();
  if (!(slope.norm() < max_slope_)) return std::nullopt;
  if (by_point != nullptr) {
    const Eigen::Matrix2d by_slope = BySlope(slope);
    by_point->leftCols<2>() = by_slope / point.z();
    by_point->col(2) = -by_slope * slope / point.z();
  }
  if (by_parameters != nullptr) {
    const double x = slope.x(), y = slope.y();
    const double s = x * x + y * y;
    *by_parameters << x * s, x * s * s, 2.0 * x * y, s + 2.0 * x * x, x * s * s * s,  //
        y * s, y * s * s, s + 2.0 * y * y, 2.0 * x * y, y * s * s * s;
  }
  return Distorted(slope);
}

double RadialTangentialLens::SlopeWithoutTangential(double image_radius) const {
  const auto radius_and_growth = [this](double r) {
    const double s = r * r;
    return std::pair(r * (1.0 + s * (k1_ + s * (k2_ + s * k3_))),
                     1.0 + s * (3.0 * k1_ + s * (5.0 * k2_ + s * 7.0 * k3_)));
  };
  return SolveGrowing(radius_and_growth, image_radius, 0.0, max_slope_, image_radius);
}

std::optional<Eigen::Vector2d> RadialTangentialLens::SlopeAt(
    const Eigen::Vector2d& image_point) const {
  const double image_radius = image_point.norm();
  if (image_radius == 0.0) return Eigen::Vector2d::Zero();
  Eigen::Vector2d slope = image_point * (SlopeWithoutTangential(image_radius) / image_radius);
  // Newton's steps on a symmetric positive definite derivative, shortened until they help and kept
  // in the disc.
  Eigen::Vector2d missing = image_point - Distorted(slope);
  for (int i = 0; i < 100 && missing.norm() > 0.0; ++i) {
    Eigen::Vector2d step = Solve(BySlope(slope), missing);
    bool closer = false;
    for (int halving = 0; halving < 30 && !closer; ++halving, step *= 0.5) {
      Eigen::Vector2d next = slope + step;
      if (const double r = next.norm(); r > max_slope_) next *= max_slope_ / r;
      const Eigen::Vector2d still_missing = image_point - Distorted(next);
      closer = still_missing.norm() < missing.norm();
      if (!closer) continue;
      slope = next;
      missing = still_missing;
    }
    if (!closer) break;
  }
  // Not there: the image point lies outside what the lens shows.
  if (!(missing.norm() <= 1e-13 * (1.0 + image_radius)) || !(slope.norm() < max_slope_))
    return std::nullopt;
  return slope;
}

std::optional<Eigen::Vector3d> RadialTangentialLens::Unproject(
    const Eigen::Vector2d& image_point) const {
  const auto slope = SlopeAt(image_point);
  if (!slope) return std::nullopt;
  return Eigen::Vector3d(slope->x(), slope->y(), 1.0).normalized();
}

}  // namespace foresight
