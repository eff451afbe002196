#pragma once

#include "core/fitting/handle/handle_detection.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// How much the edges of a door speak for its lever to point the way it does against the other way,
/// in nats: a lever points from the near edge of its door into the leaf. Positive where an edge is
/// found 20 to 220 mm behind the pivot and none as near beyond the tip, negative the other way
/// round, else 0 (docs/evaluation/handle.md, "Which way a lever points").
/// @param around the rays of some decimetres to either side of the lever
double EdgesForWay(const RaySet& around, const Plane& door, const HandleCandidate& lever);

}  // namespace foresight
