#pragma once

#include "core/fitting/valve/valve_detection.h"
#include "core/mission/mission_file.h"

namespace foresight {

/// Adds a fitted valve to the mission, stamped with the present time.
Status SaveValve(MissionFile& mission, std::int64_t scan_id, const ValveDetection& detection,
                 const SensorRig& rig);

}  // namespace foresight
