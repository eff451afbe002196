#include "core/sensor/kannala_brandt_lens.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/sensor/axial_angle.h"
#include "core/sensor/growing_function.h"
#include "core/sensor/polynomial.h"

namespace foresight {
namespace {

constexpr double kLargestCoefficient = 1e6;

/// Where the radius stops growing.
double MaxAngle(const std::array<double, 4>& k) {
  for (const double value : k)
    if (!(std::abs(value) <= kLargestCoefficient)) return 0.0;
  const std::array<double, 5> growth_by_square = {1.0, 3.0 * k[0], 5.0 * k[1], 7.0 * k[2],
                                                  9.0 * k[3]};
  constexpr double kPi = std::numbers::pi;
  const std::vector<double> ends = SignChanges(growth_by_square, kPi * kPi);
  return ends.empty() ? kPi : std::sqrt(ends.front());
}

}  // namespace

KannalaBrandtLens::KannalaBrandtLens(double k1, double k2, double k3, double k4)
    : k_{k1, k2, k3, k4}, max_angle_rad_(MaxAngle(k_)), max_radius_(Radius(max_angle_rad_)) {}

std::optional<ParameterFault> KannalaBrandtLens::FindFault() const {
  for (std::size_t i = 0; i < k_.size(); ++i)
    if (!(std::abs(k_[i]) <= kLargestCoefficient))
      return ParameterFault{
          kParameters[i], fmt::format("{} {} is not between -1e6 and 1e6", kParameters[i], k_[i])};
  return std::nullopt;
}

double KannalaBrandtLens::Radius(double angle_rad) const {
  const double s = angle_rad * angle_rad;
  return angle_rad * (1.0 + s * (k_[0] + s * (k_[1] + s * (k_[2] + s * k_[3]))));
}

double KannalaBrandtLens::RadiusByAngle(double angle_rad) const {
  const double s = angle_rad * angle_rad;
  return 1.0 + s * (3.0 * k_[0] + s * (5.0 * k_[1] + s * (7.0 * k_[2] + s * 9.0 * k_[3])));
}

std::optional<Eigen::Vector2d> KannalaBrandtLens::Project(
    const Eigen::Vector3d& point, Eigen::Matrix<double, 2, 3>* by_point,
    Eigen::Matrix<double, 2, 4>* by_parameters) const {
  const double h = std::hypot(point.x(), point.y());
  if (h == 0.0 && point.z() <= 0.0) return std::nullopt;
  AxialRadius radius = AxialAngle(h, point.z(), 1.0);
  const double angle = radius.per_h * h;
  if (!(angle < max_angle_rad_)) return std::nullopt;

  const double s = angle * angle;
  if (by_parameters != nullptr) {
    const double by_k1 = radius.per_h * s;
    for (int i = 0; i < 4; ++i) by_parameters->col(i) = by_k1 * std::pow(s, i) * point.head<2>();
  }
  const double growth = RadiusByAngle(angle);
  radius.per_h *= 1.0 + s * (k_[0] + s * (k_[1] + s * (k_[2] + s * k_[3])));
  radius.by_h *= growth;
  radius.by_depth *= growth;
  if (by_point != nullptr) *by_point = ByPoint(point, h, radius);
  return Eigen::Vector2d(radius.per_h * point.x(), radius.per_h * point.y());
}

std::optional<Eigen::Vector3d> KannalaBrandtLens::Unproject(
    const Eigen::Vector2d& image_point) const {
  const double radius = image_point.norm();
  if (!(radius < max_radius_)) return std::nullopt;
  if (radius == 0.0) return Eigen::Vector3d::UnitZ();
  const auto radius_and_growth = [this](double angle) {
    return std::pair(Radius(angle), RadiusByAngle(angle));
  };
  const double angle = SolveGrowing(radius_and_growth, radius, 0.0, max_angle_rad_, radius);
  const double stretch = std::sin(angle) / radius;
  return Eigen::Vector3d(stretch * image_point.x(), stretch * image_point.y(), std::cos(angle))
      .normalized();
}

}  // namespace foresight
