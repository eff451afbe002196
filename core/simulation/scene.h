#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/rigid.h"
#include "core/objects/handle_model.h"
#include "core/objects/valve_model.h"
#include "core/simulation/board_stand.h"
#include "core/simulation/material.h"

namespace foresight {

/// One triangle mesh in the robot's frame; every solid of a scene is made into one.
struct SceneMesh {
  std::string name;
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;
  Material material;
  Rigid<frame::Robot, frame::Object> robot_from_object;  ///< where the pattern is fixed
  /// What is printed on the side that -z of the object looks from, in `color` (paper) and `color2`
  /// (ink) in place of the material's pattern; nullptr = nothing.
  std::shared_ptr<const BoardFace> face = {};
};

/// What a scene knows to be true of an object in it.
struct ValveTruth {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;
  ValveModel model;
};
struct DrillTruth {
  std::string name;
  /// x = the way the bit points, z = up; the origin is where the grip's axis intersects the surface
  /// that the battery stands on.
  Rigid<frame::Robot, frame::Object> robot_from_object;
  double scale = 1.0;  ///< 1 = 0.24 m tall
  /// Lean of the grip and the head about x and y of the object, against the foot.
  Eigen::Vector2d body_tilt_rad = Eigen::Vector2d::Zero();
  double grip_height_m = 0.125;  ///< of the grip's middle along its axis
};
struct BlockTruth {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;  ///< centre of the top face, z = its normal
  Eigen::Vector3d size_m;
};

struct HandleTruth {
  std::string name;
  Rigid<frame::Robot, frame::Object> robot_from_object;  ///< as HandleModel defines the frame
  HandleModel model;
};

struct BoardTruth {
  std::string name;
  CalibrationBoard board;  ///< as drawn
  Rigid<frame::Robot, frame::Pattern> robot_from_pattern;
  std::vector<Eigen::Vector3d> corners;  ///< as printed, in pattern
};

struct Light {
  Eigen::Vector3d position_m = {0.0, 0.0, 2.5};  ///< in robot
  double intensity = 1.0;                        ///< 1 = a well lit room at 2 m
};

/// A world to look at, in the robot's frame (x forward, y left, z up; metres).
struct Scene {
  std::string name;
  std::vector<SceneMesh> meshes;
  std::vector<Light> lights;
  double ambient = 0.35;  ///< light from everywhere, as a fraction of light 1
  std::vector<ValveTruth> valves;
  std::vector<DrillTruth> drills;
  std::vector<BlockTruth> blocks;
  std::vector<HandleTruth> handles;
  std::vector<BoardTruth> boards;
  // What somebody carries from place to place. None of it is in `meshes` before AtPlace.
  std::vector<BoardStand> stands;
  std::vector<StandPlace> places;
};

/// Reads a scene file, docs/simulation.md. Fails with kBadData, naming the file and the line; an
/// unknown key is an error. LoadScene reads the meshes that a scene names from its own folder; what
/// comes from no file can have none.
Result<Scene> SceneFromYaml(const std::string& yaml, const std::string& source);
Result<Scene> LoadScene(const std::filesystem::path& path);

}  // namespace foresight
