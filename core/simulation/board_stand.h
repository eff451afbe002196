#pragma once

#include <optional>
#include <string>

#include "core/objects/board_mount.h"
#include "core/simulation/board_face.h"
#include "core/simulation/material.h"

namespace foresight {

struct Scene;

/// A printed calibration board as it is.
struct BoardObject {
  CalibrationBoard board;  ///< as drawn
  PrintErrors errors = {};
  double margin_m = 0.010;  ///< of white paper around the squares
  Material material = {};   ///< `color` of the paper, `color2` of the ink

  /// Names the member at fault.
  Status Check() const;
};

/// One board, or two that are fixed to each other. The frame is the first board's frame::Pattern.
struct BoardStand {
  std::string name;
  BoardObject a;
  std::optional<BoardObject> b = {};
  BoardFromBoard a_from_b = {};  ///< as built

  /// As drawn but for a_from_b.
  BoardMount Mount() const;
};

/// Where somebody puts a stand.
struct StandPlace {
  std::string name;
  int stand = 0;  ///< of Scene::stands
  Rigid<frame::Robot, frame::Pattern> robot_from_stand;
};

/// The pose of a stand whose middle (of its boards' middles) is at a place, and which faces the
/// robot upright (the mean of its boards' normals along x of robot, y of the pattern down) before
/// it is turned by `rotation`.
Rigid<frame::Robot, frame::Pattern> StandPose(const BoardStand& stand,
                                              const Eigen::Vector3d& position_m,
                                              const Eigen::Quaterniond& rotation);

/// Adds the boards' meshes and their truth to the scene.
void AddStand(const BoardStand& stand, const Rigid<frame::Robot, frame::Pattern>& robot_from_stand,
              Scene& scene);

/// The scene while a stand is at its place `place`, from 1; 0 = all stands are away. @pre a place
Scene AtPlace(const Scene& scene, int place);

}  // namespace foresight
