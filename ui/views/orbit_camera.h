#pragma once

#include <Eigen/Core>

namespace foresight {

/// A camera that turns about the point it looks at and keeps z up: no roll to get lost in.
struct OrbitCamera {
  Eigen::Vector3d focal = Eigen::Vector3d::Zero();  ///< the point looked at
  double azimuth_rad = 0.0;    ///< of the camera seen from the focal point; 0 = behind it along -x
  double elevation_rad = 0.3;  ///< of the camera above the focal point
  double distance_m = 2.0;

  Eigen::Vector3d Position() const;
  void Orbit(double by_azimuth_rad, double by_elevation_rad);
  void Zoom(double factor);
  /// Moves the focal point in the image's plane, in metres to the right and up.
  void Pan(double right_m, double up_m);
};

}  // namespace foresight
