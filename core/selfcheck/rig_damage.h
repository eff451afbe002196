#pragma once

#include <Eigen/Core>
#include <string>

#include "core/sensor/sensor_rig.h"

namespace foresight {

/// What a head may have suffered since it was calibrated.
struct RigDamage {
  std::string name;  ///< "none", "camera turn x", "lidar turn y", "stamps", ...
  Eigen::Vector3d camera_turn_rad = Eigen::Vector3d::Zero();  ///< of camera_from_head, in camera
  Eigen::Vector3d lidar_turn_rad = Eigen::Vector3d::Zero();   ///< about the lidar's axes
  double stamp_s = 0.0;
  double motor_scale = 0.0;  ///< the plate turns so much farther than the motor says, of its turn
  /// And is off by so much, kHarmonic times a turn, from this phase on.
  double motor_harmonic_rad = 0.0;
  double motor_phase_rad = 0.0;
  static constexpr int kHarmonic = 6;

  bool IsNone() const {
    return camera_turn_rad.isZero(0.0) && lidar_turn_rad.isZero(0.0) && stamp_s == 0.0 &&
           motor_scale == 0.0 && motor_harmonic_rad == 0.0;
  }
};

/// The rig that a head was calibrated with before it suffered `damage` and became `true_rig`: the
/// same, bit for bit, where it suffered none.
SensorRig RigBefore(const RigDamage& damage, const SensorRig& true_rig);

}  // namespace foresight
