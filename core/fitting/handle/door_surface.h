#pragma once

#include <optional>

#include "core/fitting/handle/handle_detection.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// What a handle sits on: a plane, or two parallel ones with an edge between them, a door's leaf
/// and its frame.
struct DoorSurface {
  Plane door;  ///< in base, where the handle's pivot is; its normal to the viewer
  std::optional<Plane> beside = std::nullopt;  ///< beyond the edge
};

/// The door again, once it is known which rays may end on the handle: least squares over all other
/// rays near the `rough` plane, and where two parallel planes 5 to 60 mm apart explain the rays
/// clearly better (Schwarz's criterion), those. Their edge is straight, within 10 deg of a right
/// angle to the lever and beside it, as a leaf's is. A plane through a leaf and its frame is
/// several degrees off. Where too few rays are left `rough` stays. O(rays x edges that are tried).
/// @param normal_known the rough plane's normal is that of DoorAmongLevels: it may change by what
/// that one is off by
DoorSurface DoorRound(const RaySet& rays, const Plane& rough, bool normal_known,
                      const HandleCandidate& handle);

}  // namespace foresight
