#pragma once

#include "core/sensor/sensor_rig.h"

namespace foresight {

/// How a rig differs from another one, such as the true one, in what does not depend on the gauge.
/// The robot's frame is not compared.
struct RigError {
  double focal_px = 0.0;  ///< the larger one of fx and fy; means something for one lens model only
  /// Where both see the same ray, over the image: rms and most. NaN where no ray is seen by both.
  double camera_rms_px = 0.0;
  double camera_most_px = 0.0;
  double axis_rad = 0.0;        ///< direction of the motor's axis in camera
  double axis_m = 0.0;          ///< distance of the axes next to the camera
  double angles_rms_rad = 0.0;  ///< plate angles against that at 0, at the knots of both
  double angles_most_rad = 0.0;
  double lidar_rad = 0.0;  ///< camera_from_lidar
  double lidar_m = 0.0;
  double range_offset_m = 0.0;  ///< signed: the rig's less the other's
  double stamp_offset_s = 0.0;  ///< signed
};

/// Fails with kInvalidInput for heads of different kinds: other image sizes or numbers of beams.
Result<RigError> CompareRigs(const SensorRig& rig, const SensorRig& other);

}  // namespace foresight
