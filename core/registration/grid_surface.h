#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/registration/register_scan.h"

namespace foresight {

struct GridSurfaceOptions {
  /// A triangle's longest side, in multiples of the distance between neighbouring beams there: at
  /// 12 a wall is closed up to an angle of incidence of 85 deg, and an edge in depth stays open.
  double max_side_ratio = 12.0;
  double min_side_m = 0.03;  ///< noise makes no holes in near surfaces

  Status Check() const;  ///< Fails with kInvalidOptions.
};

/// The measured grid as triangles: two for every four neighbours (two lines, two beams), but for
/// those that span an edge in depth. Indices count the valid returns row by row, as PointsInRobot
/// lists them; corners run counter-clockwise seen from the lidar. Fails with kTooFewPoints where no
/// triangle is left. O(points).
Result<std::vector<std::array<std::int32_t, 3>>> GridSurface(const RegisteredScan& cloud,
                                                             const GridSurfaceOptions& options);

}  // namespace foresight
