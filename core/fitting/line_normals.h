#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/ray_set.h"

namespace foresight {

/// For each ray the normal of the plane that its scan line lies in, in base, length 1: the way a
/// footprint extends across its line. Of a line with one ray the mean normal. 0 for rays without
/// scan lines, whose footprints are round. O(rays).
std::vector<Eigen::Vector3d> LineNormalsOf(const RaySet& rays);

}  // namespace foresight
