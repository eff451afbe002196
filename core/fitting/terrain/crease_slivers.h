#pragma once

#include "core/fitting/terrain/surface_planes.h"

namespace foresight {

/// Takes away narrow planes that larger ones explain: where two surfaces meet, normals bend from
/// one to the other, and those in between look like a plane of their own that cuts a strip off
/// both. A plane of less than 0.08 m2 is dissolved when at least 35 % of its points lie within 12
/// mm of a larger plane that reaches there; its points belong to none then. Planes are fitted
/// again, those below `min_area_m2` dropped. O(points).
void DissolveCreaseSlivers(const SurfaceGrid& grid, double min_area_m2, SurfacePlanes& surfaces);

}  // namespace foresight
