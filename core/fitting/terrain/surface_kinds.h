#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/terrain/terrain_detection.h"

namespace foresight {

/// Tells ground from unknown planes, among the surfaces that are no blocks: ground is level, and
/// nothing level that is as large as a block's top lies below it; a block whose sides do not drop
/// (`drops`, one a surface) and that lies in the ground is ground too.
void TellGround(const Eigen::Vector3d& up, const std::vector<int>& drops,
                std::vector<TerrainSurface>& surfaces);

/// Fills in each block's step: to the nearest other block's centre, else to the ground below.
void MeasureSteps(const Eigen::Vector3d& up, std::vector<TerrainSurface>& surfaces);

}  // namespace foresight
