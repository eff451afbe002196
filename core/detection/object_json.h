#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/fitting/drill/drill_detection.h"
#include "core/fitting/terrain/terrain_detection.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// What each kind of detection says beyond verdict and origin (json_values.h). Readers throw.
nlohmann::json ToJson(const ValveDetection& detection,
                      const Rigid<frame::Robot, frame::Base>& robot_from_base);
nlohmann::json ToJson(const DrillDetection& detection,
                      const Rigid<frame::Robot, frame::Base>& robot_from_base);
nlohmann::json ToJson(const TerrainDetection& detection,
                      const Rigid<frame::Robot, frame::Base>& robot_from_base);

ValveDetection ValveFrom(const nlohmann::json& value);
DrillDetection DrillFrom(const nlohmann::json& value);
TerrainDetection TerrainFrom(const nlohmann::json& value);

}  // namespace foresight
