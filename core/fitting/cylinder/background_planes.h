#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/fitting/cylinder/cylinder_state.h"
#include "core/geometry/plane.h"

namespace foresight {

/// The flat surfaces of a region, those with most points first; at most 3. Nothing says that they
/// are not slabs through something round: ask PlanesBeside.
std::vector<Plane> FindFlatSurfaces(const RaySet& rays, Random& random);

/// Those of the planes that are no slabs through the cylinder: less than half of their points lie
/// on it. First the one behind its middle, if any.
std::vector<Plane> PlanesBeside(const CylinderState& cylinder, const std::vector<Plane>& planes,
                                const RaySet& rays);

}  // namespace foresight
