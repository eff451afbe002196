#include "core/fitting/drill/support_and_background.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/fitting/drill/find_tables.h"

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kMinWallFraction = 0.12;
constexpr int kMinWallPoints = 25;
constexpr int kMaxWalls = 3;
constexpr double kMinWallWidth_m = 0.36;     // no drill is
constexpr double kMinWallHeight_m = 0.10;    // of the middle four fifths
constexpr double kMaxBehindFraction = 0.04;  // of the points: a wall hides what is behind it
constexpr double kWallUpright = 0.3;         // |normal . up|
constexpr double kNearestFraction = 0.08;

/// Half the thickness of a wall.
double Tolerance(const RaySet& rays) {
  return 2.0 * rays.sigma_m + kUnevenSurface_m;
}

Points PointsOf(const Beams& beams) {
  Points points;
  for (const RangeRay& ray : beams) points.push_back(ray.Point());
  return points;
}

double WidthAlong(const Points& points, const Eigen::Vector3d& along) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector3d& point : points) {
    low = std::min(low, along.dot(point));
    high = std::max(high, along.dot(point));
  }
  return high - low;
}

/// Whether it stands up: the strip of a table that an upright slab cuts out does not.
bool Tall(const Points& points, const Eigen::Vector3d& up) {
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : points) heights.push_back(up.dot(point));
  std::sort(heights.begin(), heights.end());
  const std::size_t tenth = heights.size() / 10;
  return heights[heights.size() - 1 - tenth] - heights[tenth] > kMinWallHeight_m;
}

bool HidesAll(const Plane& plane, const Beams& beams, double tolerance_m) {
  std::size_t behind = 0;
  for (const RangeRay& ray : beams)
    behind += plane.Distance(ray.Point()) < -2.0 * tolerance_m ? 1u : 0u;
  return static_cast<double>(behind) < kMaxBehindFraction * static_cast<double>(beams.size());
}

/// Walls among the points; takes their points away, and the few behind them.
std::vector<Plane> TakeWalls(const RaySet& rays, const Eigen::Vector3d& up, Beams& beams,
                             Random& random) {
  std::vector<Plane> walls;
  const auto upright = [&](const Plane& plane) {
    return std::abs(plane.normal.dot(up)) < kWallUpright ? 1.0 : 0.0;
  };
  const std::size_t least = std::max<std::size_t>(
      kMinWallPoints,
      static_cast<std::size_t>(kMinWallFraction * static_cast<double>(beams.size())));
  Beams all = beams;
  for (int i = 0; i < kMaxWalls; ++i) {
    const auto rough = BestPlane(all, rays.sigma_m, upright, random);
    if (!rough) break;
    const Points near = PointsOf(EndingOn(all, *rough, rays.sigma_m));
    if (near.size() < least) break;
    Plane wall = FitPlane(near).value_or(*rough);
    if (wall.Distance(rays.viewpoint) < 0.0) wall = {-wall.normal, -wall.offset};
    std::erase_if(all, [&](const RangeRay& ray) {
      return std::abs(wall.Distance(ray.Point())) < 1.5 * Tolerance(rays);
    });
    const bool wide = WidthAlong(near, up.cross(wall.normal).normalized()) > kMinWallWidth_m;
    if (!wide || !Tall(near, up) || !HidesAll(wall, beams, Tolerance(rays))) continue;
    walls.push_back(wall);
    std::erase_if(beams, [&](const RangeRay& ray) {
      return wall.Distance(ray.Point()) < 3.0 * rays.sigma_m + 0.006;
    });
  }
  return walls;
}

/// Keeps what is not further behind the nearest points than `depth_m`, seen from above.
void KeepNearest(const RaySet& rays, const Eigen::Vector3d& up, double depth_m, Points& points) {
  if (points.empty()) return;
  const auto distance = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d from = point - rays.viewpoint;
    return (from - from.dot(up) * up).norm();
  };
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : points) distances.push_back(distance(point));
  const auto nearest =
      distances.begin() +
      static_cast<std::ptrdiff_t>(kNearestFraction * static_cast<double>(distances.size()));
  std::nth_element(distances.begin(), nearest, distances.end());
  const double limit = *nearest + depth_m;
  std::erase_if(points, [&](const Eigen::Vector3d& point) { return distance(point) > limit; });
}

}  // namespace

SupportAndBackground FindSupportAndBackground(const RaySet& rays,
                                              const SupportAndBackgroundOptions& options,
                                              Random& random) {
  Beams beams = rays.rays;
  // Walls first: a level slab through a large wall can hold more points than a table seen at a
  // grazing angle.
  const std::vector<Plane> walls = TakeWalls(rays, options.up, beams, random);
  SupportAndBackground found;
  found.planes = FindTables(rays, beams, {options.up, options.max_table_tilt_rad}, random);
  if (!found.planes.empty()) found.table = found.planes.front();
  Points points = PointsOf(beams);
  const double above = std::max(0.015, 2.5 * rays.sigma_m);
  if (found.table)
    std::erase_if(points,
                  [&](const Eigen::Vector3d& p) { return found.table->Distance(p) < above; });
  found.planes.insert(found.planes.end(), walls.begin(), walls.end());
  const Eigen::Vector3d up = found.table ? found.table->normal : options.up;
  KeepNearest(rays, up, options.depth_m, points);
  found.foreground = std::move(points);
  return found;
}

}  // namespace foresight
