#pragma once

#include "core/sensor/sensor_rig.h"
#include "tests/support/shrink_camera.h"

namespace foresight {

/// The default head with an image of half the width and height: what a window shows and a program
/// writes are the same, at a quarter of the work.
inline SensorRig HalfCameraRig() {
  SensorRig rig = DefaultSensorRig();
  Shrink(0.5, &rig.camera);
  return rig;
}

/// The default head with an image of a quarter of the width and height.
inline SensorRig SmallCameraRig() {
  SensorRig rig = DefaultSensorRig();
  Shrink(0.25, &rig.camera);
  return rig;
}

}  // namespace foresight
