#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "core/sensor/parameter_fault.h"

namespace foresight {

/// The paper's fisheye lens, Eq. (1)-(3), in the reading of docs/paper_map.md: the viewing ray of
/// the image point at radius r passes the plane z = 1 at the radius tan(k r) / k. k = 1 is the
/// equidistant lens; k = 0 is allowed and means a pinhole. The FOV model of Devernay and Faugeras
/// is the same with k = 2 tan(w / 2) and f_FOV = f w / k.
///
/// As in every lens here, image points are in units of the focal lengths from the principal point,
/// and points and rays are in the camera's frame.
struct FisheyeLens {
  static constexpr std::string_view kModel = "fisheye_k";
  static constexpr std::array<std::string_view, 1> kParameters = {"k"};

  double k = 1.0;

  static FisheyeLens FromParameters(const std::array<double, 1>& values) { return {values[0]}; }
  std::array<double, 1> Parameters() const { return {k}; }
  std::optional<ParameterFault> FindFault() const;

  /// Where a point appears, with its derivatives where a pointer is not null. nullopt behind a
  /// pinhole and on the backward axis.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Eigen::Matrix<double, 2, 3>* by_point,
                                         Eigen::Matrix<double, 2, 1>* by_parameters) const;
  /// The unit ray; defined for k r < pi.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& image_point) const;

  bool operator==(const FisheyeLens&) const = default;
};

}  // namespace foresight
