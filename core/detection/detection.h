#pragma once

#include <string>
#include <variant>

#include "core/fitting/drill/drill_detection.h"
#include "core/fitting/terrain/terrain_detection.h"
#include "core/fitting/valve/valve_detection.h"

namespace foresight {

/// What was found in a region: one of the known objects.
using Detection = std::variant<ValveDetection, DrillDetection, TerrainDetection>;

/// "valve", "drill", "terrain": the kind in files and on command lines.
const char* KindOf(const Detection& detection);
const Verdict& VerdictOf(const Detection& detection);
const FitOrigin& OriginOf(const Detection& detection);

}  // namespace foresight
