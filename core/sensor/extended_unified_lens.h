#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "core/sensor/parameter_fault.h"

namespace foresight {

/// The extended unified camera model (EUCM) of Khomutenko, Garcia and Martinet: with
/// d = sqrt(beta (X^2 + Y^2) + Z^2) a point appears at (X, Y) / (alpha d + (1 - alpha) Z).
/// alpha = 0 is a pinhole. The lens sees the cone Z > -w d, with w = alpha / (1 - alpha) up to
/// alpha = 0.5 and (1 - alpha) / alpha above: there two rays would share an image point.
struct ExtendedUnifiedLens {
  static constexpr std::string_view kModel = "eucm";
  static constexpr std::array<std::string_view, 2> kParameters = {"alpha", "beta"};

  double alpha = 0.0;
  double beta = 1.0;

  static ExtendedUnifiedLens FromParameters(const std::array<double, 2>& values) {
    return {values[0], values[1]};
  }
  std::array<double, 2> Parameters() const { return {alpha, beta}; }
  std::optional<ParameterFault> FindFault() const;

  /// Where a point appears, with its derivatives where a pointer is not null. nullopt outside the
  /// cone.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Eigen::Matrix<double, 2, 3>* by_point,
                                         Eigen::Matrix<double, 2, 2>* by_parameters) const;
  /// The unit ray. With alpha above 0.5 nullopt from the radius 1 / sqrt((2 alpha - 1) beta) on.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& image_point) const;

  bool operator==(const ExtendedUnifiedLens&) const = default;
};

}  // namespace foresight
