#include "core/selfcheck/rig_damage.h"

#include "core/calibration/tangent.h"

namespace foresight {

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
  return rig;
}

}  // namespace foresight
