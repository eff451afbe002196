#pragma once

#include <vector>

#include "core/fitting/drill/region_planes.h"
#include "core/geometry/angles.h"

namespace foresight {

struct TableOptions {
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  ///< against gravity, in base, length 1
  double max_tilt_rad = RadiansFromDegrees(15.0);
};

/// The level surfaces among `beams`, those of a region that end on no wall, in base, normal up: the
/// table first, then what lies lower. A level slice through a standing thing is none. Where it is
/// known what lies round the region (RaySet::around), the table is the highest level surface within
/// 0.4 m of the region's middle that the thing there may stand on, also where the region does not
/// show it. Empty where no table is seen.
std::vector<Plane> FindTables(const RaySet& region, const Beams& beams, const TableOptions& options,
                              Random& random);

}  // namespace foresight
