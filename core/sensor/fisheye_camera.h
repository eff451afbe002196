#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/base/result.h"

namespace foresight {

/// The paper's fisheye camera, Eq. (1)-(3), in the reading of docs/paper_map.md: with
/// x = (u - cx) / fx, y = (v - cy) / fy and r = |(x, y)|, the viewing ray passes the plane z = 1 at
/// the radius tan(k r) / k. k = 1 is the equidistant lens; k = 0 is allowed and means a pinhole.
/// Pixel (0, 0) is the centre of the first pixel. Points and rays are in the camera's frame.
struct FisheyeCamera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  double k = 1.0;

  Status Check() const;

  /// Where a point appears. nullopt behind a pinhole, on the backward axis, or beyond the lens's
  /// domain; a result may lie outside the image.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point) const;

  /// Same, with the derivatives by the point (2x3) and by fx, fy, cx, cy, k (2x5).
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point,
                                         Eigen::Matrix<double, 2, 3>* by_point,
                                         Eigen::Matrix<double, 2, 5>* by_parameters) const;

  /// The unit ray seen by a pixel; defined for k r < pi, nullopt beyond.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& pixel) const;

  /// (X/Z, Y/Z) of a pixel's ray; nullopt at 90 deg from the axis and beyond.
  std::optional<Eigen::Vector2d> UnprojectToPlane(const Eigen::Vector2d& pixel) const;

  bool InImage(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 &&
           pixel.y() < height - 0.5;
  }

  bool operator==(const FisheyeCamera&) const = default;
};

/// A pinhole camera: the same model with k = 0.
FisheyeCamera PinholeCamera(int width, int height, double focal_px, double cx, double cy);

}  // namespace foresight
