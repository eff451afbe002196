#pragma once

#include <Eigen/Core>
#include <string>

#include "core/base/random.h"
#include "core/simulation/scene.h"

namespace foresight {

/// Where the things of a terrain scene stand.
struct TerrainLayout {
  double ground_m = 0.0;                                 ///< its height in robot
  double yaw_rad = 0.0;                                  ///< of the rows against robot's x
  Eigen::Vector2d middle_m = Eigen::Vector2d(1.5, 0.0);  ///< in robot

  /// The pose of something at a place of the layout (x away from the robot, z above the ground).
  Rigid<frame::Robot, frame::Object> At(const Eigen::Vector3d& place, double yaw_rad) const;
};

/// Cinder block, asphalt, timber: dull, grey to brown, plain or with a fine pattern.
Material RandomConcrete(Random& random);

void AddBox(const std::string& name, const Eigen::Vector3d& size_m,
            const Rigid<frame::Robot, frame::Object>& robot_from_box, const Material& material,
            Scene& scene);

/// Slightly rough ground, walls far away, lights.
void AddHall(const TerrainLayout& layout, Random& random, Scene& scene);

}  // namespace foresight
