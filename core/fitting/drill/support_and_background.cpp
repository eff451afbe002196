#include "core/fitting/drill/support_and_background.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kTrials = 300;
constexpr double kMinTableFraction = 0.04;
constexpr int kMinTablePoints = 14;
constexpr int kMaxTables = 3;
constexpr double kMinWallFraction = 0.12;
constexpr int kMinWallPoints = 25;
constexpr int kMaxWalls = 3;
constexpr double kMinWallWidth_m = 0.36;     // no drill is
constexpr double kMinWallHeight_m = 0.10;    // of the middle four fifths
constexpr double kMaxBehindFraction = 0.04;  // of the points: a wall hides what is behind it
constexpr double kWallUpright = 0.3;         // |normal . up|
constexpr double kLevelSigma_rad = 0.035;    // how level tables are: 2 deg
constexpr double kFloorBehind_m = 0.6;       // a level surface this much further is no table
constexpr double kShelfBelow_m = 0.15;
constexpr double kNearestFraction = 0.08;

double Tolerance(const RaySet& rays) {
  return 2.0 * rays.sigma_m + 0.004;
}

/// The plane through three of the points that most lie on, among those that `allowed` lets pass.
std::optional<Plane> BestPlane(const Points& points, double tolerance_m,
                               const std::function<bool(const Plane&)>& allowed, Random& random) {
  std::optional<Plane> best;
  int most = 0;
  const int count = static_cast<int>(std::ssize(points));
  if (count < 3) return best;
  const auto drawn = [&] { return points[static_cast<std::size_t>(random.Index(count))]; };
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d a = drawn(), b = drawn(), c = drawn();
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    if (cross.norm() < 1e-6) continue;
    const Plane plane{cross.normalized(), cross.normalized().dot(a)};
    if (!allowed(plane)) continue;
    int inliers = 0;
    for (const Eigen::Vector3d& point : points)
      inliers += std::abs(plane.Distance(point)) < tolerance_m ? 1 : 0;
    if (inliers <= most) continue;
    most = inliers;
    best = plane;
  }
  return best;
}

Points Near(const Points& points, const Plane& plane, double tolerance_m) {
  Points near;
  for (const Eigen::Vector3d& point : points)
    if (std::abs(plane.Distance(point)) < tolerance_m) near.push_back(point);
  return near;
}

void EraseNear(Points& points, const Plane& plane, double tolerance_m) {
  std::erase_if(points, [&](const Eigen::Vector3d& point) {
    return std::abs(plane.Distance(point)) < tolerance_m;
  });
}

Eigen::Vector3d Mean(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Least squares with a prior: two scan lines at a grazing angle fix a table's height, but hardly
/// its tilt.
Plane LevelPlane(const Points& points, const Eigen::Vector3d& up, double sigma_m) {
  const Eigen::Vector3d x = up.unitOrthogonal();
  const Eigen::Vector3d y = up.cross(x);
  const Eigen::Vector3d mean = Mean(points);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  information(0, 0) = information(1, 1) = 1.0 / (kLevelSigma_rad * kLevelSigma_rad);
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d row(x.dot(point - mean), y.dot(point - mean), 1.0);
    information += row * row.transpose() / (sigma_m * sigma_m);
    right += row * up.dot(point - mean) / (sigma_m * sigma_m);
  }
  const Eigen::Vector3d slopes = information.ldlt().solve(right);
  const Eigen::Vector3d normal = (up - slopes.x() * x - slopes.y() * y).normalized();
  return {normal, normal.dot(mean + slopes.z() * up)};
}

double MedianDistance(const Points& points, const Eigen::Vector3d& from) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : points) distances.push_back((point - from).norm());
  const auto middle = distances.begin() + std::ssize(distances) / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

struct LevelSurface {
  Plane plane;
  std::size_t points = 0;
  double distance_m = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

/// Level planes, the table first: the largest, but not the floor that shows beyond its edge.
std::vector<Plane> FindTables(const RaySet& rays, Points points,
                              const SupportAndBackgroundOptions& options, Random& random) {
  const double least_cosine = std::cos(options.max_table_tilt_rad);
  const auto level = [&](const Plane& plane) {
    return std::abs(plane.normal.dot(options.up)) > least_cosine;
  };
  const std::size_t least = std::max<std::size_t>(
      kMinTablePoints,
      static_cast<std::size_t>(kMinTableFraction * static_cast<double>(points.size())));
  std::vector<LevelSurface> found;
  for (int i = 0; i < kMaxTables; ++i) {
    const auto rough = BestPlane(points, Tolerance(rays), level, random);
    if (!rough) break;
    Points near = Near(points, *rough, Tolerance(rays));
    if (near.size() < least) break;
    Plane plane = LevelPlane(near, options.up, rays.sigma_m);
    near = Near(points, plane, Tolerance(rays));
    if (near.size() < least) break;
    plane = LevelPlane(near, options.up, rays.sigma_m);
    found.push_back({plane, near.size(), MedianDistance(near, rays.viewpoint), Mean(near)});
    EraseNear(points, plane, 1.5 * Tolerance(rays));
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const LevelSurface& level_surface : found)
    nearest = std::min(nearest, level_surface.distance_m);
  const auto far = [&](const LevelSurface& it) { return it.distance_m > nearest + kFloorBehind_m; };
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return far(a) != far(b) ? far(b) : a.points > b.points;
  });
  // Above the table a level slab is a cut through what stands there; below, a shelf or the floor.
  std::vector<Plane> tables;
  for (const LevelSurface& level_surface : found) {
    const double below =
        tables.empty() ? kShelfBelow_m : tables.front().Distance(level_surface.middle) * -1.0;
    if (below >= kShelfBelow_m) tables.push_back(level_surface.plane);
  }
  return tables;
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

bool HidesAll(const Plane& plane, const Points& points, double tolerance_m) {
  std::size_t behind = 0;
  for (const Eigen::Vector3d& point : points)
    behind += plane.Distance(point) < -2.0 * tolerance_m ? 1u : 0u;
  return static_cast<double>(behind) < kMaxBehindFraction * static_cast<double>(points.size());
}

/// Walls among the points; takes their points away, and the few behind them.
std::vector<Plane> TakeWalls(const RaySet& rays, const Eigen::Vector3d& up, Points& points,
                             Random& random) {
  std::vector<Plane> walls;
  const auto upright = [&](const Plane& plane) {
    return std::abs(plane.normal.dot(up)) < kWallUpright;
  };
  const std::size_t least = std::max<std::size_t>(
      kMinWallPoints,
      static_cast<std::size_t>(kMinWallFraction * static_cast<double>(points.size())));
  Points all = points;
  for (int i = 0; i < kMaxWalls; ++i) {
    const auto rough = BestPlane(all, Tolerance(rays), upright, random);
    if (!rough) break;
    const Points near = Near(all, *rough, Tolerance(rays));
    if (near.size() < least) break;
    Plane wall = FitPlane(near).value_or(*rough);
    if (wall.Distance(rays.viewpoint) < 0.0) wall = {-wall.normal, -wall.offset};
    EraseNear(all, wall, 1.5 * Tolerance(rays));
    const bool wide = WidthAlong(near, up.cross(wall.normal).normalized()) > kMinWallWidth_m;
    if (!wide || !Tall(near, up) || !HidesAll(wall, points, Tolerance(rays))) continue;
    walls.push_back(wall);
    EraseNear(points, wall, 3.0 * rays.sigma_m + 0.006);
    std::erase_if(points, [&](const Eigen::Vector3d& p) { return wall.Distance(p) < 0.0; });
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
  Points points;
  for (const RangeRay& ray : rays.rays) points.push_back(ray.Point());
  // Walls first: a level slab through a large wall can hold more points than a table seen at a
  // grazing angle.
  const std::vector<Plane> walls = TakeWalls(rays, options.up, points, random);
  SupportAndBackground found;
  found.planes = FindTables(rays, points, options, random);
  if (!found.planes.empty()) found.table = found.planes.front();
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
