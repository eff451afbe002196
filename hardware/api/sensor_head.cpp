#include "hardware/api/sensor_head.h"

#include "hardware/api/camera.h"
#include "hardware/api/lidar.h"
#include "hardware/api/motor.h"
#include "hardware/api/sensor_clock.h"

namespace foresight {

const char* ToString(HeadState state) {
  switch (state) {
    case HeadState::kDisconnected:
      return "disconnected";
    case HeadState::kHoming:
      return "homing";
    case HeadState::kReady:
      return "ready";
    case HeadState::kSweeping:
      return "sweeping";
    case HeadState::kStopping:
      return "stopping";
    case HeadState::kFault:
      return "fault";
  }
  return "unknown";
}

}  // namespace foresight
