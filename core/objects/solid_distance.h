#pragma once

#include <Eigen/Core>

#include "core/objects/solid_part.h"

namespace foresight {

/// Signed distance to the surface of a solid, negative inside, of a point in the solid's own frame,
/// whose middle is the origin. `half` is half the size, of a round one (radius, radius, half
/// length), a capsule's without its ends.
double DistanceToSolid(SolidPart::Shape shape, const Eigen::Vector3d& point,
                       const Eigen::Vector3d& half);

}  // namespace foresight
