#pragma once

#include <string>

#include "core/evaluation/terrain_layout.h"

namespace foresight {

/// Adds something to the scene that is no block of the known size: nothing at all, stairs, boxes
/// of other sizes, a ramp, rubble, a table's edge or a wall. Returns what.
std::string AddTerrainDistractor(const TerrainLayout& layout, Random& random, Scene& scene);

}  // namespace foresight
