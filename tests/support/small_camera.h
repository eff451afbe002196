#pragma once

#include "core/sensor/sensor_rig.h"

namespace foresight {

/// The default head with an image of a quarter of the width and height.
inline SensorRig SmallCameraRig() {
  SensorRig rig = DefaultSensorRig();
  CameraModel& camera = rig.camera;
  camera.width /= 4;
  camera.height /= 4;
  camera.fx /= 4;
  camera.fy /= 4;
  camera.cx = 0.25 * (camera.cx + 0.5) - 0.5;
  camera.cy = 0.25 * (camera.cy + 0.5) - 0.5;
  return rig;
}

}  // namespace foresight
