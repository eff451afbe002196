#pragma once

#include <vector>

#include "core/fitting/terrain/surface_planes.h"

namespace foresight {

/// How far planes reach beyond their points on a grid.
class PlaneReach {
 public:
  explicit PlaneReach(const SurfaceGrid& grid)
      : grid_(grid), visited_(static_cast<std::size_t>(grid.size()), -1) {}

  /// The points within 60 mm of a plane's `own`, counted in cells of the grid and at most 12 of
  /// them; its own come first. O(points found).
  std::vector<int> Around(const std::vector<int>& own);

 private:
  const SurfaceGrid& grid_;
  std::vector<int> visited_;  ///< the last search that met a point
  int searches_ = 0;
};

}  // namespace foresight
