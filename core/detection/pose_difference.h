#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/detection/detection.h"

namespace foresight {

/// One thing that was found, where it is in the robot's frame.
struct PlacedObject {
  std::string uuid;  ///< of its detection
  std::string kind;  ///< "valve", "drill", "terrain", "handle", "cylinder"
  std::string text;  ///< CandidateText: "4 spokes, rim 240 mm across"
  VerdictLevel level = VerdictLevel::kUnsure;
  Rigid<frame::Robot, frame::Object> robot_from_object;
  /// How many turns about the object's z give the same object: 4 for a wheel of four spokes; 0 =
  /// any turn does (a disc, a cylinder); 1 = none.
  int turns = 1;
};

/// The best answer of a detection; of a terrain, each surface.
std::vector<PlacedObject> PlacedObjectsOf(const Detection& detection, const std::string& uuid,
                                          const Rigid<frame::Robot, frame::Base>& robot_from_base);

/// How an object lies to another one, in the axes of the first.
struct PoseDifference {
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();   ///< of the origin, along the axes
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  ///< rotation vector, about the axes
  double distance_m = 0.0;
  double angle_rad = 0.0;  ///< the smallest of the turns that give the same object
};

PoseDifference DifferenceOf(const PlacedObject& first, const PlacedObject& second);

/// Two objects that are the same thing, or one that has no partner.
struct ObjectPair {
  std::optional<PlacedObject> first;
  std::optional<PlacedObject> second;
  std::optional<PoseDifference> difference;  ///< of pairs
};

/// Objects of one kind that are nearest to each other become pairs, the nearest first, none further
/// apart than `reach_m`; then what is left over. Pairs are in the order of the first list.
std::vector<ObjectPair> MatchObjects(const std::vector<PlacedObject>& first,
                                     const std::vector<PlacedObject>& second,
                                     double reach_m = 0.30);

}  // namespace foresight
