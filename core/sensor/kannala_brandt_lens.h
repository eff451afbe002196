#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "core/sensor/parameter_fault.h"

namespace foresight {

/// The lens of Kannala and Brandt with four coefficients, as OpenCV's cv::fisheye has it: a ray at
/// the angle theta from the axis appears at the radius
///   r = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8).
/// A polynomial bends back somewhere. The lens ends at the angle where r stops growing (180 deg at
/// most): beyond, two rays would share an image point. That angle is found once, here, so a lens's
/// values do not change.
class KannalaBrandtLens {
 public:
  static constexpr std::string_view kModel = "kb4";
  static constexpr std::array<std::string_view, 4> kParameters = {"k1", "k2", "k3", "k4"};

  KannalaBrandtLens() : KannalaBrandtLens(0.0, 0.0, 0.0, 0.0) {}
  KannalaBrandtLens(double k1, double k2, double k3, double k4);

  static KannalaBrandtLens FromParameters(const std::array<double, 4>& values) {
    return {values[0], values[1], values[2], values[3]};
  }
  const std::array<double, 4>& Parameters() const { return k_; }
  std::optional<ParameterFault> FindFault() const;

  /// The angle from the axis, and the radius in the image, where the lens ends.
  double max_angle_rad() const { return max_angle_rad_; }
  double max_radius() const { return max_radius_; }

  /// Where a point appears, with its derivatives where a pointer is not null. nullopt on the
  /// backward axis and beyond max_angle_rad.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Eigen::Matrix<double, 2, 3>* by_point,
                                         Eigen::Matrix<double, 2, 4>* by_parameters) const;
  /// The unit ray; nullopt beyond max_radius.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& image_point) const;

  bool operator==(const KannalaBrandtLens&) const = default;

 private:
  double Radius(double angle_rad) const;
  double RadiusByAngle(double angle_rad) const;

  std::array<double, 4> k_;
  double max_angle_rad_;
  double max_radius_;
};

}  // namespace foresight
