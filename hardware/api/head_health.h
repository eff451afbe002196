#pragma once

#include <string>

#include "core/base/result.h"
#include "hardware/api/camera_health.h"
#include "hardware/api/lidar_health.h"
#include "hardware/api/motor_health.h"

namespace foresight {

/// How the devices of one head do, at one moment.
struct HeadHealth {
  LidarHealth lidar;
  CameraHealth camera;
  MotorHealth motor;
};

/// "40 lines/s, 0 lost, clock offset 12.345 s": the numbers an operator looks at.
std::string Describe(const LidarHealth& lidar);
/// "12 images, 0 lost, 41.5 °C"; without a temperature where the camera has no sensor.
std::string Describe(const CameraHealth& camera);
/// "240 polls/s, round trip 0.03 ms".
std::string Describe(const MotorHealth& motor);

/// All members as one line of JSON, named as here; what is not known is null.
std::string ToJson(const HeadHealth& health);
/// The reverse; what the text does not have stays at its default. Fails with kBadData.
Result<HeadHealth> HeadHealthFromJson(const std::string& text);

}  // namespace foresight
