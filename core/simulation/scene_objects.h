#pragma once

#include <string>

#include "core/simulation/scene.h"

namespace foresight {

/// A wheel or a lever on its stem, in front of a flange.
struct ValveObject {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;  ///< as ValveModel defines the object frame
  ValveModel model;
  double stem_length_m =
      0.10;  ///< from the hub's centre (a lever's pivot) back to the flange's face
  double stem_radius_m = 0.012;
  double flange_radius_m = 0.05;
  Material wheel_material;
  Material body_material;
};

/// A cordless drill standing on its battery; frame as DrillTruth.
struct DrillObject {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;
  double scale = 1.0;
  Material shell_material;
  Material grip_material;
  Material metal_material;
};

/// Two cinder blocks side by side; frame as BlockTruth.
struct BlockObject {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;
  Eigen::Vector3d size_m = {0.397, 0.390, 0.143};
  Material material;
};

/// Each adds the object's meshes and its truth to the scene.
void AddValve(const ValveObject& valve, Scene& scene);
void AddDrill(const DrillObject& drill, Scene& scene);
void AddBlock(const BlockObject& block, Scene& scene);

/// The pose of a valve whose axis (towards the viewer, in robot) and first spoke are given. A phase
/// of 0 puts the first spoke as far up as the axis allows, positive ones turn it counter-clockwise
/// for the viewer. The axis is not vertical.
Rigid<frame::Robot, frame::Object> ValvePose(const Eigen::Vector3d& position_m,
                                             const Eigen::Vector3d& axis, double phase_rad);

}  // namespace foresight
