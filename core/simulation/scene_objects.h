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

/// How a cordless drill is built, at scale 1 and in its own frame; the defaults are those of a
/// common 18 V drill (239 x 73 x 247 mm with battery).
struct DrillShape {
  enum class Kind {
    kBarrel,   ///< a round head lies across the grip
    kBoxHead,  ///< the same with a boxy head
    kCutOut,   ///< an upright motor housing on a battery, the bit upwards in a guard
  };
  Kind kind = Kind::kBarrel;
  Eigen::Vector3d foot_m = {0.117, 0.073, 0.062};
  double foot_forward_m = 0.006;  ///< of the foot's middle before the grip's axis
  double grip_radius_m = 0.0255;
  double grip_depth_m = 0.0;     ///< the grip is this much longer along x than across
  double head_height_m = 0.208;  ///< of the head's axis; of a cut-out tool's guard
  double head_radius_m = 0.034;  ///< half the sides of a boxy head
  double head_back_m = 0.070;    ///< behind the grip's axis, without the round end
  double head_front_m = 0.085;
  double chuck_radius_m = 0.020;
  double chuck_length_m = 0.037;
  double bit_radius_m = 0.004;
  double bit_length_m = 0.070;  ///< 0 = none
  bool trigger = true;
  bool side_handle = false;  ///< to the left of the head's front
  /// Lean of all but the foot about x and y, as DrillModel::body_tilt_rad.
  Eigen::Vector2d body_tilt_rad = Eigen::Vector2d::Zero();
};

/// A cordless drill standing on its battery; frame as DrillTruth.
struct DrillObject {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;
  double scale = 1.0;
  DrillShape shape = {};
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

/// A lever on its neck and plate; the door that it is on is not part of it.
struct HandleObject {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;  ///< as HandleModel defines the frame
  HandleModel model;
  Material lever_material;
  Material plate_material;
};

/// Each adds the object's meshes and its truth to the scene.
void AddValve(const ValveObject& valve, Scene& scene);
/// Stem, gland, flange and bolts alone, behind a wheel or a lever that was added another way.
void AddValveBody(const ValveObject& valve, Scene& scene);
void AddDrill(const DrillObject& drill, Scene& scene);
void AddBlock(const BlockObject& block, Scene& scene);
void AddHandle(const HandleObject& handle, Scene& scene);

/// The pose of a valve whose axis (towards the viewer, in robot) and first spoke are given. A phase
/// of 0 puts the first spoke as far up as the axis allows, positive ones turn it counter-clockwise
/// for the viewer. The axis is not vertical.
Rigid<frame::Robot, frame::Object> ValvePose(const Eigen::Vector3d& position_m,
                                             const Eigen::Vector3d& axis, double phase_rad);

}  // namespace foresight
