#pragma once

#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/angles.h"
#include "core/geometry/plane.h"

namespace foresight {

/// What a standing thing has round it in a region.
struct SupportAndBackground {
  std::optional<Plane> table;  ///< in base, normal up
  std::vector<Plane> planes;   ///< table, other level surfaces and walls: what lies behind
  /// Points in base that stand on the table before the walls, not far behind the nearest of them.
  std::vector<Eigen::Vector3d> foreground;
};

struct SupportAndBackgroundOptions {
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  ///< against gravity, in base, length 1
  double max_table_tilt_rad = RadiansFromDegrees(15.0);
  double depth_m = 0.36;  ///< of what stands there, at most
};

/// Finds upright walls first, which must be wider than any drill and have nothing behind them; then
/// the table, with gravity's direction as a prior; only then what is nearest: a wall at the end of
/// a region would otherwise pass for the thing that stands before it.
SupportAndBackground FindSupportAndBackground(const RaySet& rays,
                                              const SupportAndBackgroundOptions& options,
                                              Random& random);

}  // namespace foresight
