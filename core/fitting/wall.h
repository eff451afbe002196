#pragma once

#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

/// What lies behind the object in a region, and what does not.
struct WallSplit {
  std::optional<Plane> wall;  ///< in base; its normal points to the viewer
  /// In base: nearer than the wall, or all without one; in the region's box, unless that holds
  /// hardly any of them.
  std::vector<Eigen::Vector3d> foreground;
};

/// Range at which a ray intersects the front of a plane; 1e9 when it never does.
double RangeToPlane(const RangeRay& ray, const Plane& plane);

/// Finds the plane that most of the region's background belongs to. Nothing large may lie behind
/// it: else the wheel itself, which is flat too, would be taken for the wall.
WallSplit SplitWall(const RaySet& rays, Random& random);
/// All of it is foreground.
WallSplit NoWall(const RaySet& rays);

}  // namespace foresight
