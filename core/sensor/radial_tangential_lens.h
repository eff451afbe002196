#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "core/sensor/parameter_fault.h"

namespace foresight {

/// A pinhole with radial and tangential distortion, as OpenCV's calib3d has it. With x = X / Z,
/// y = Y / Z, r = |(x, y)| and R = 1 + k1 r^2 + k2 r^4 + k3 r^6 a point appears at
///   (x R + 2 p1 x y + p2 (r^2 + 2 x^2),  y R + p1 (r^2 + 2 y^2) + 2 p2 x y).
/// A polynomial bends back somewhere: the lens ends at a radius max_slope in the plane z = 1, up to
/// which no two rays share an image point. That radius is found once, here, so a lens's values do
/// not change. With p1 = p2 = 0 it is where the radius in the image stops growing.
class RadialTangentialLens {
 public:
  static constexpr std::string_view kModel = "radtan";
  static constexpr std::array<std::string_view, 5> kParameters = {"k1", "k2", "p1", "p2", "k3"};

  RadialTangentialLens() : RadialTangentialLens(0.0, 0.0, 0.0, 0.0, 0.0) {}
  RadialTangentialLens(double k1, double k2, double p1, double p2, double k3);

  /// In OpenCV's order.
  static RadialTangentialLens FromParameters(const std::array<double, 5>& values) {
    return {values[0], values[1], values[2], values[3], values[4]};
  }
  std::array<double, 5> Parameters() const { return {k1_, k2_, p1_, p2_, k3_}; }
  std::optional<ParameterFault> FindFault() const;

  /// The tangent of the largest angle from the axis.
  double max_slope() const { return max_slope_; }

  /// Where a point appears, with its derivatives where a pointer is not null. nullopt for Z <= 0
  /// and beyond max_slope.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Eigen::Matrix<double, 2, 3>* by_point,
                                         Eigen::Matrix<double, 2, 5>* by_parameters) const;
  /// The unit ray; nullopt where no ray below max_slope appears.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& image_point) const;

  bool operator==(const RadialTangentialLens&) const = default;

 private:
  Eigen::Vector2d Distorted(const Eigen::Vector2d& slope) const;
  Eigen::Matrix2d BySlope(const Eigen::Vector2d& slope) const;
  double SlopeWithoutTangential(double image_radius) const;
  std::optional<Eigen::Vector2d> SlopeAt(const Eigen::Vector2d& image_point) const;

  double k1_, k2_, p1_, p2_, k3_;
  double max_slope_;
};

}  // namespace foresight
