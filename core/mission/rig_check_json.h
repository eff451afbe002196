#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/selfcheck/check_rig.h"

namespace foresight {

/// What a check found of a rig, as one JSON object: docs/formats.md, "Self-checks".
std::string RigCheckToJson(const RigCheck& check);

/// What such a check measured, for GatherRig: `camera`, `plate`, `turns` and `passes`. Its findings
/// are not read, for JudgeRig makes them again. A measurement whose covariance cannot be inverted
/// is left out; checks of earlier programs kept no measurements and have neither. Throws as the
/// readers of core/io/json_reader.h do.
RigCheck RigMeasurementsFromJson(const nlohmann::json& json);

}  // namespace foresight
