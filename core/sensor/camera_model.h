#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/extended_unified_lens.h"
#include "core/sensor/fisheye_lens.h"
#include "core/sensor/kannala_brandt_lens.h"
#include "core/sensor/radial_tangential_lens.h"

namespace foresight {

/// What a camera's lens can be. docs/adr/0013-camera-models.md says why these.
using Lens =
    std::variant<FisheyeLens, RadialTangentialLens, KannalaBrandtLens, ExtendedUnifiedLens>;

/// How a calibrated camera sees: a lens of one of several models, focal lengths and principal
/// point. A value: cheap to copy, no allocation. Pixel (0, 0) is the centre of the first pixel;
/// near the axis the image has fx and fy pixels a radian. Points and rays are in the camera's
/// frame.
///
/// Every lens has a domain on which projection and ray are each other's inverse; outside of it both
/// answer nullopt, never a wrong value.
struct CameraModel {
  /// The most parameters that a model has: fx, fy, cx, cy and five of a lens.
  static constexpr int kMaxParameters = 9;
  using ByPoint = Eigen::Matrix<double, 2, 3>;
  using ByParameters = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxParameters>;
  using Parameters = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxParameters, 1>;

  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  Lens lens;

  /// Names the parameter at fault.
  Status Check() const;
  std::optional<ParameterFault> FindFault() const;

  /// The model as rig files name it: "fisheye_k", "radtan", "kb4", "eucm".
  std::string_view Key() const;
  /// The model in words: "fisheye with k", "pinhole", "radial-tangential", "Kannala-Brandt (KB4)",
  /// "extended unified (EUCM)".
  std::string_view Name() const;

  /// "fx", "fy", "cx", "cy", then the lens's, in the order of Values() and of the derivatives.
  std::vector<std::string_view> ParameterNames() const;
  Parameters Values() const;
  /// The same model, and size of image, with other values. @pre as many as Values() has
  CameraModel WithValues(const Parameters& values) const;

  /// Where a point appears. nullopt outside the lens's domain; a result may lie outside the image.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point) const;
  /// Same, with the derivatives by the point and by the parameters; null = not wanted.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point, ByPoint* by_point,
                                         ByParameters* by_parameters) const;

  /// The unit ray seen by a pixel, in the image or beyond; nullopt where the lens shows nothing.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& pixel) const;

  /// (X/Z, Y/Z) of a pixel's ray; nullopt at 90 deg from the axis and beyond.
  std::optional<Eigen::Vector2d> UnprojectToPlane(const Eigen::Vector2d& pixel) const;

  bool InImage(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 &&
           pixel.y() < height - 0.5;
  }

  bool operator==(const CameraModel&) const = default;
};

/// A pinhole camera: the paper's model with k = 0.
CameraModel PinholeCamera(int width, int height, double focal_px, double cx, double cy);

}  // namespace foresight
