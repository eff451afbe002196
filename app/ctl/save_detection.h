#pragma once

#include "core/detection/detection.h"
#include "core/mission/mission_file.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// Adds a found object to the mission, stamped with the present time.
Status SaveDetection(MissionFile& mission, std::int64_t scan_id, const Detection& detection,
                     const SensorRig& rig);

}  // namespace foresight
