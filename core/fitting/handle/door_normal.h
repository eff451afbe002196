#pragma once

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

/// A door that is known roughly, with the normal of all that lies round its handle: a leaf, its
/// frame and the wall are parallel and reach ten times as far as a lever, and most measurements
/// that are 60 to 250 mm apart lie on one of them. The normal within 15 deg of the rough one that
/// explains most of their differences in height, by Welsch's estimator. The plane lies at the level
/// that most of the region's rays end on. Where less than 200 measurements lie round it `rough`
/// comes back. O(measurements, 2000 of them at most).
Plane DoorAmongLevels(const RaySet& around, const RaySet& region, const Plane& rough,
                      Random& random);

}  // namespace foresight
