#pragma once

#include <string>

#include "core/evaluation/terrain_layout.h"

namespace foresight {

/// Adds something to the scene that is no block of the known size: nothing at all, stairs, boxes
/// of other sizes, a ramp, rubble, a table's edge or a wall. Returns what.
std::string AddTerrainDistractor(const TerrainLayout& layout, Random& random, Scene& scene);

/// Adds cartons that a fit may take for blocks: one side is a block's, the other a tenth to a third
/// longer or shorter. Returns what.
std::string AddCartons(const TerrainLayout& layout, Random& random, Scene& scene);

}  // namespace foresight
