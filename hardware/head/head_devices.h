#pragma once

#include <memory>

#include "hardware/api/camera.h"
#include "hardware/api/head_health.h"
#include "hardware/api/lidar.h"
#include "hardware/api/motor.h"
#include "hardware/api/sensor_clock.h"

namespace foresight {

/// The devices of one head. All are there; connecting is up to the head.
struct HeadDevices {
  std::unique_ptr<Lidar> lidar;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Motor> motor;
  std::shared_ptr<SensorClock> clock;
};

/// Safe from any thread; never waits for a device.
inline HeadHealth ReadHealth(const HeadDevices& devices) {
  return {devices.lidar->Health(), devices.camera->Health(), devices.motor->Health()};
}

}  // namespace foresight
