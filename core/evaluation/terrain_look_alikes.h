#pragma once

#include <string>

#include "core/evaluation/terrain_stage.h"

namespace foresight {

/// Puts something on the stage that is no block of the known size: nothing at all, stairs, boxes of
/// other sizes, a ramp, rubble, a table's edge or a wall. Returns what.
std::string AddTerrainLookAlike(const TerrainStage& stage, Random& random, Scene& scene);

}  // namespace foresight
