#include "core/fitting/terrain/surface_planes.h"

#include <algorithm>
#include <cmath>

#include "core/base/tukey_weight.h"
#include "core/fitting/terrain/range_plane.h"

namespace foresight {
namespace {

constexpr double kRoughness_m = 0.002;
constexpr double kTukeySigmas = 4.0;
constexpr int kGrowRounds = 3;
constexpr double kLeastClosing = 0.05;  // cosine between ray and normal, for areas

/// False when the points make no plane.
bool Refit(const SurfaceGrid& grid, const std::vector<int>& points, SurfacePlane& surface) {
  if (points.size() < 3) return false;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const int i : points) center += grid[i].point;
  center /= static_cast<double>(points.size());
  for (int round = 0; round < kGrowRounds; ++round) {
    RangePlaneSums sums(grid.viewpoint(), center - grid.viewpoint());
    const bool known = round > 0 || surface.points > 0;
    for (const int i : points)
      sums.Add(grid[i].point, known ? TukeyWeight((surface.plane.Distance(grid[i].point) /
                                                   DistanceSigma(grid, i, surface.plane)) /
                                                  kTukeySigmas)
                                    : 1.0);
    const auto plane = sums.Solve();
    if (!plane) return false;
    surface.plane = *plane;
  }
  surface.center = center - surface.plane.Distance(center) * surface.plane.normal;
  surface.points = static_cast<int>(points.size());
  surface.area_m2 = 0.0;
  double squares = 0.0, weights = 0.0;
  for (const int i : points) {
    const double error = surface.plane.Distance(grid[i].point);
    const double weight =
        TukeyWeight((error / DistanceSigma(grid, i, surface.plane)) / kTukeySigmas);
    squares += weight * error * error;
    weights += weight;
    surface.area_m2 += AreaOn(surface.plane, grid[i], grid[i].range_m);
  }
  surface.rms_m = std::sqrt(squares / std::max(1.0, weights));
  return true;
}

}  // namespace

std::vector<std::vector<int>> PointsOfEach(const SurfacePlanes& surfaces) {
  std::vector<std::vector<int>> points(surfaces.planes.size());
  for (std::size_t i = 0; i < surfaces.labels.size(); ++i)
    if (surfaces.labels[i] >= 0)
      points[static_cast<std::size_t>(surfaces.labels[i])].push_back(static_cast<int>(i));
  return points;
}

double DistanceSigma(const SurfaceGrid& grid, int i, const Plane& plane) {
  return std::hypot(kRoughness_m, grid.sigma_m() * plane.normal.dot(grid[i].direction));
}

double AreaOn(const Plane& plane, const GridPoint& point, double range_m) {
  const double closing = std::max(kLeastClosing, std::abs(plane.normal.dot(point.direction)));
  return range_m * range_m * point.solid_angle_sr / closing;
}

double LengthOn(const Plane& plane, const Eigen::Vector3d& direction, double range_m,
                double angle_rad) {
  constexpr double kLeast = 0.1;
  return range_m * angle_rad / std::max(kLeast, std::abs(plane.normal.dot(direction)));
}

void RefitPlanes(const SurfaceGrid& grid, double min_area_m2, SurfacePlanes& surfaces) {
  const std::vector<std::vector<int>> points = PointsOfEach(surfaces);
  std::vector<int> renamed(surfaces.planes.size(), -1);
  std::vector<SurfacePlane> kept;
  for (std::size_t k = 0; k < surfaces.planes.size(); ++k) {
    SurfacePlane surface = surfaces.planes[k];
    if (!Refit(grid, points[k], surface) || surface.area_m2 < min_area_m2) continue;
    renamed[k] = static_cast<int>(kept.size());
    kept.push_back(surface);
  }
  surfaces.planes = std::move(kept);
  for (int& label : surfaces.labels)
    if (label >= 0) label = renamed[static_cast<std::size_t>(label)];
}

}  // namespace foresight
