#pragma once

#include <vector>

#include "core/fitting/terrain/terrain_detection.h"

namespace foresight {

/// Notes on each block how far it is from the block of `last` that it matches: the nearest one
/// that is not nearer to another, within half a block's size and 30 deg.
void MarkShifts(const TerrainDetection& last, std::vector<TerrainSurface>& surfaces);

/// The turn between two blocks; a quarter turn of a nearly square one cannot be seen and is none.
double TurnBetween(const TerrainSurface& a, const TerrainSurface& b);

}  // namespace foresight
