#include "core/fitting/terrain/crease_slivers.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/terrain/plane_reach.h"

namespace foresight {
namespace {

constexpr double kNarrow_m2 = 0.080;  // half a block's top
constexpr double kNear_m = 0.012;
constexpr double kExplained = 0.35;

/// 1 for each point that lies on a plane large enough to be trusted.
std::vector<char> NearLargePlane(const SurfaceGrid& grid, const SurfacePlanes& surfaces,
                                 const std::vector<std::vector<int>>& own) {
  std::vector<char> near(static_cast<std::size_t>(grid.size()), 0);
  PlaneReach reach(grid);
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (surfaces.planes[k].area_m2 < kNarrow_m2) continue;
    for (const int i : reach.Around(own[k]))
      if (std::abs(surfaces.planes[k].plane.Distance(grid[i].point)) < kNear_m)
        near[static_cast<std::size_t>(i)] = 1;
  }
  return near;
}

}  // namespace

void DissolveCreaseSlivers(const SurfaceGrid& grid, double min_area_m2, SurfacePlanes& surfaces) {
  const std::vector<std::vector<int>> own = PointsOfEach(surfaces);
  const std::vector<char> near = NearLargePlane(grid, surfaces, own);
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (surfaces.planes[k].area_m2 >= kNarrow_m2) continue;
    const auto explained = std::count_if(own[k].begin(), own[k].end(), [&near](int i) {
      return near[static_cast<std::size_t>(i)] != 0;
    });
    if (static_cast<double>(explained) < kExplained * static_cast<double>(own[k].size())) continue;
    for (const int i : own[k]) surfaces.labels[static_cast<std::size_t>(i)] = -1;
  }
  RefitPlanes(grid, min_area_m2, surfaces);
}

}  // namespace foresight
