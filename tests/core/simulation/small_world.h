#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "core/sensor/sensor_rig.h"
#include "core/simulation/scene.h"
#include "core/simulation/world.h"

namespace foresight::test {

/// A scene from the body of a scene file; the header and one grey material are put before it.
inline std::shared_ptr<const Scene> SceneOf(const std::string& body) {
  auto scene = SceneFromYaml("foresight_scene: 1\nname: test\n" + body, "test.yaml");
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::make_shared<const Scene>(std::move(*scene));
}

/// The default head, at the robot's origin, with a camera that renders in milliseconds.
inline SensorRig SmallRig() {
  SensorRig rig = DefaultSensorRig();
  rig.camera = {.width = 64,
                .height = 48,
                .fx = 30.0,
                .fy = 30.0,
                .cx = 31.5,
                .cy = 23.5,
                .lens = FisheyeLens{0.9413}};
  rig.robot_from_base = {rig.robot_from_base.rotation(), Eigen::Vector3d::Zero()};
  return rig;
}

inline WorldOptions Noiseless() {
  WorldOptions options;
  options.lidar.enabled = false;
  options.camera.enabled = false;
  options.motor.enabled = false;
  return options;
}

inline double Still(double) {
  return 0.0;
}

/// Where a beam of the head starts and points, in robot, for a true plate angle.
struct Beam {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};
inline Beam BeamOf(const SensorRig& rig, int beam, double plate_rad) {
  const auto robot_from_lidar =
      rig.robot_from_base * HeadFromBase(plate_rad).Inverse() * rig.HeadFromLidar();
  return {robot_from_lidar.translation(), robot_from_lidar.Rotate(rig.lidar.BeamDirection(beam))};
}

}  // namespace foresight::test
