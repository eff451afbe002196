#include "core/fitting/terrain/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/fitting/terrain/range_plane.h"

namespace foresight {
namespace {

constexpr double kWindowSigmas = 5.5;
constexpr double kMinWindow_m = 0.035;
constexpr double kMaxWindow_m = 0.075;
// Where beams are far apart, seen at a grazing angle more so, a window must still hold some.
constexpr double kWindowSteps = 5.0;
constexpr double kMaxSparseWindow_m = 0.150;
constexpr double kDepthGateWindows = 1.5;
constexpr int kFarthestCell = 24;      // in a window, of each direction
constexpr int kCellsAcross = 5;        // looked at to each side; wider windows skip cells
constexpr double kLeastWeight = 5.0;   // points that agree
constexpr double kMostOblique = 0.05;  // cosine between ray and normal

double WindowRadius(const SurfaceGrid& grid, int i) {
  const double by_noise = std::clamp(kWindowSigmas * grid.sigma_m(), kMinWindow_m, kMaxWindow_m);
  const double by_steps = kWindowSteps * grid[i].range_m * grid.step_rad().maxCoeff();
  return std::max(by_noise, std::min(by_steps, kMaxSparseWindow_m));
}

std::vector<int> WindowAround(const SurfaceGrid& grid, int i, double radius_m) {
  const GridPoint& here = grid[i];
  const auto cells = [&](double step_rad) {
    return std::clamp(static_cast<int>(radius_m / (here.range_m * step_rad)), 1, kFarthestCell);
  };
  const int wide = cells(grid.step_rad().x()), high = cells(grid.step_rad().y());
  const int skip_x = 1 + (wide - 1) / kCellsAcross, skip_y = 1 + (high - 1) / kCellsAcross;
  std::vector<int> window;
  window.reserve(128);
  for (int dy = -high / skip_y * skip_y; dy <= high; dy += skip_y) {
    for (int dx = -wide / skip_x * skip_x; dx <= wide; dx += skip_x) {
      const int j = grid.Neighbor(i, dx, dy);
      if (j < 0) continue;
      const GridPoint& other = grid[j];
      if (std::abs(other.range_m - here.range_m) < kDepthGateWindows * radius_m &&
          (other.point - here.point).squaredNorm() < 2.25 * radius_m * radius_m)
        window.push_back(j);
    }
  }
  return window;
}

Eigen::Vector3d NormalAt(const SurfaceGrid& grid, int i) {
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const GridPoint& here = grid[i];
  const std::vector<int> window = WindowAround(grid, i, WindowRadius(grid, i));
  RangePlaneSums sums(here.origin, here.direction);
  for (const int j : window) sums.Add(grid[j].point, 1.0);
  if (sums.weight() < kLeastWeight) return none;
  auto plane = sums.Solve();
  if (!plane) return none;
  RangePlaneSums again(here.origin, here.direction);
  for (const int j : window) {
    const GridPoint& other = grid[j];
    const double tolerance_m =
        2.0 * std::hypot(0.003, grid.sigma_m() * plane->normal.dot(other.direction));
    const double error = plane->Distance(other.point) / tolerance_m;
    const double weight = 1.0 / (1.0 + error * error);
    again.Add(other.point, weight * weight);
  }
  if (again.weight() < 0.5 * kLeastWeight) return none;
  plane = again.Solve();
  if (!plane || -plane->normal.dot(here.direction) < kMostOblique) return none;
  return plane->normal;
}

}  // namespace

std::vector<Eigen::Vector3d> SurfaceNormals(const SurfaceGrid& grid, const RunContext& context) {
  constexpr int kBatch = 512;
  std::vector<Eigen::Vector3d> normals(static_cast<std::size_t>(grid.size()));
  const bool finished = ParallelFor((grid.size() + kBatch - 1) / kBatch, context, [&](int batch) {
    for (int i = batch * kBatch; i < std::min(grid.size(), (batch + 1) * kBatch); ++i)
      normals[static_cast<std::size_t>(i)] = NormalAt(grid, i);
  });
  return finished ? normals : std::vector<Eigen::Vector3d>();
}

}  // namespace foresight
