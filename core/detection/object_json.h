#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/fitting/cylinder/cylinder_detection.h"
#include "core/fitting/drill/drill_detection.h"
#include "core/fitting/handle/handle_detection.h"
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
nlohmann::json ToJson(const HandleDetection& detection,
                      const Rigid<frame::Robot, frame::Base>& robot_from_base);
nlohmann::json ToJson(const CylinderDetection& detection,
                      const Rigid<frame::Robot, frame::Base>& robot_from_base);

ValveDetection ValveFrom(const nlohmann::json& value);
DrillDetection DrillFrom(const nlohmann::json& value);
TerrainDetection TerrainFrom(const nlohmann::json& value);
HandleDetection HandleFrom(const nlohmann::json& value);
CylinderDetection CylinderFrom(const nlohmann::json& value);

/// The member `model` of a candidate, and a surface's `kind`.
nlohmann::json ToJson(const ValveModel& model);
nlohmann::json ToJson(const DrillModel& model);
nlohmann::json ToJson(const HandleModel& model);
ValveModel ValveModelFrom(const nlohmann::json& value);
DrillModel DrillModelFrom(const nlohmann::json& value);
HandleModel HandleModelFrom(const nlohmann::json& value);
CylinderModel CylinderModelFrom(const nlohmann::json& value);
TerrainSurface::Kind SurfaceKindFrom(const std::string& name);

}  // namespace foresight
