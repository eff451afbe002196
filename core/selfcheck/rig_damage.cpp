#include "core/selfcheck/rig_damage.h"

#include <cmath>

#include "core/base/contract.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"

namespace foresight {

namespace {

/// With a knot every two degrees, so that the spline has the harmonic.
AngleCorrection CorrectionBefore(const RigDamage& damage, const AngleCorrection& true_correction) {
  std::vector<AngleCorrection::Knot> knots;
  for (int degrees = -90; degrees <= 90; degrees += 2) {
    const double motor_rad = RadiansFromDegrees(degrees);
    const double off = damage.motor_scale * motor_rad +
                       damage.motor_harmonic_rad *
                           std::sin(RigDamage::kHarmonic * motor_rad + damage.motor_phase_rad);
    knots.push_back({motor_rad, true_correction.PlateAngle(motor_rad) - off});
  }
  const auto correction = AngleCorrection::FromKnots(std::move(knots));
  FORESIGHT_EXPECTS(correction.has_value(),
                    "a plate that is off by little turns as the motor does");
  return *correction;
}

}  // namespace

SensorRig RigBefore(const RigDamage& damage, const SensorRig& true_rig) {
  if (damage.IsNone()) return true_rig;  // a turn by nothing normalises anew
  const Eigen::Quaterniond camera = RotationExp(-damage.camera_turn_rad);
  const Eigen::Quaterniond lidar = RotationExp(-damage.lidar_turn_rad);
  SensorRig rig = true_rig;
  rig.camera_from_head = {camera * true_rig.camera_from_head.rotation(),
                          camera * true_rig.camera_from_head.translation()};
  rig.camera_from_lidar = {camera * true_rig.camera_from_lidar.rotation() * lidar,
                           camera * true_rig.camera_from_lidar.translation()};
  rig.lidar.stamp_offset_s -= damage.stamp_s;
  if (damage.motor_scale != 0.0 || damage.motor_harmonic_rad != 0.0)
    rig.angle_correction = CorrectionBefore(damage, true_rig.angle_correction);
  return rig;
}

}  // namespace foresight
