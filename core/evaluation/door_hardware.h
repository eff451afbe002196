#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/objects/handle_model.h"
#include "core/simulation/scene.h"

namespace foresight {

/// Something on a door: meshes in the door's frame (the door is z = 0, z its normal, x to the right
/// and y up for who looks at the door, the origin where the pivot would be).
struct DoorHardware {
  std::string name;  ///< how it was drawn: "lever", "knob", "pull bar", ...
  std::vector<SceneMesh> parts;
  /// What lies beside it and belongs to no handle: a lock's rose, a key.
  std::vector<SceneMesh> beside;
  /// What was drawn as a lever; of other things it means nothing.
  HandleModel model;
  Rigid<frame::Object, frame::Object> door_from_handle;
};

/// Levers with round, flat and oval sections, straight, bowed or with a cranked neck, free and
/// returned ends, on round and square rosettes and on long plates, with and without a lock beside
/// them. Level and to either side; one in eight turned, as a window's or one that is held down.
DoorHardware DrawLever(Random& random, const Material& material, const Material& other);
/// What is meant to be no lever handle: knobs, pull bars and bows with two posts, bars on one, a
/// bare lock, a thumb turn, a cable on clips, a bracket, a light switch, a pipe, a hook, a hinge, a
/// bolt.
DoorHardware DrawOtherDoorThing(Random& random, const Material& material, const Material& other);

/// A door's frame in robot; `yaw_rad` = the way to it, seen from above, when it is faced squarely.
Rigid<frame::Robot, frame::Object> DoorFacing(const Eigen::Vector3d& position, double yaw_rad,
                                              double lean_rad);
/// Adds meshes that are drawn in a door's frame.
void Hang(std::vector<SceneMesh> parts, const Rigid<frame::Robot, frame::Object>& robot_from_door,
          Scene& scene);

/// What a thing on a door is, whoever drew it: measured by rays 3 mm apart from the front and from
/// the door outwards.
struct DoorThingMeasures {
  double height_m = 0.0;  ///< of its highest point off the door
  double length_m = 0.0;  ///< of what stands 22 mm and more off the door, along its longest way
  double width_m = 0.0;   ///< of that across, at its widest
  /// From its carried end to the last place that is solid down to the door, or to the plate on it.
  double carried_m = 0.0;
  double free_m = 0.0;  ///< of its other end, where nothing carries it
  /// A bar 85 to 205 mm long, at most 0.45 of that and 55 mm wide and 30 to 115 mm high, that is
  /// carried from the door at one end (55 % of it is free) and ends free at the other.
  bool IsLeverHandle() const;
};
DoorThingMeasures MeasureDoorThing(const DoorHardware& hardware);

}  // namespace foresight
