#include "core/fitting/drill/find_tables.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/quantile.h"
#include "core/base/squared.h"
#include "core/fitting/ray_selection.h"

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kMinTableFraction = 0.04;
constexpr int kMinTablePoints = 14;
constexpr int kMaxTables = 3;
constexpr int kMaxSlices = 3;
constexpr int kRefits = 6;
constexpr double kLevelSigma_rad = 0.035;  // how level tables are: 2 deg
constexpr double kCountedTilt_rad = 0.12;  // deviation of WeightOfTilt
constexpr double kFloorBehind_m = 0.6;     // a level surface this much further is no table
constexpr double kShelfBelow_m = 0.15;
// Round the region's middle, seen from above: what a thing there may stand on, and the thing with
// what is under it.
constexpr double kSurroundingsRadius_m = 0.4;
constexpr double kUnderRadius_m = 0.25;
constexpr std::size_t kMostNear = 1500;
// A level slice through a standing thing has parts of that thing below half of its own points: at
// least two points within this distance, seen from above, and not far below.
constexpr double kSupportRadius_m = 0.04;
constexpr double kMinDepth_m = 0.02, kMaxDepth_m = 0.10;
constexpr int kMinSupportPoints = 2;
constexpr double kSliceFraction = 0.5;
// A slice through a foot is no wider than feet are; tables are, and go on beyond a region.
constexpr double kLeastWide_m = 0.17;
// A beam that ends 1 to this many tolerances from a plane ends beside it.
constexpr double kBeside = 3.0;
// A thing stands on the highest of the level surfaces that are so wide and have so many times the
// beams of the largest: the top of a box beside it is smaller.
constexpr double kLeastWideRound_m = 0.25;
constexpr double kHighestFraction = 0.15;
// Height of the lowest fiftieth of a region's points over a table that the region does not show.
constexpr double kLeastOver_m = -0.03, kMostOver_m = 0.10;

Eigen::Vector3d Mean(const Beams& beams) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : beams) sum += ray.Point();
  return sum / static_cast<double>(beams.size());
}

/// Least squares with a prior: two scan lines at a grazing angle fix a table's height, but hardly
/// its tilt.
Plane LevelPlane(const Beams& beams, const Eigen::Vector3d& up, double sigma_m) {
  const Eigen::Vector3d x = up.unitOrthogonal();
  const Eigen::Vector3d y = up.cross(x);
  const Eigen::Vector3d mean = Mean(beams);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  information(0, 0) = information(1, 1) = 1.0 / (kLevelSigma_rad * kLevelSigma_rad);
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : beams) {
    const Eigen::Vector3d from = ray.Point() - mean;
    const Eigen::Vector3d row(x.dot(from), y.dot(from), 1.0);
    const double sigma = std::hypot(sigma_m * up.dot(ray.direction), kUnevenSurface_m);
    information += row * row.transpose() / (sigma * sigma);
    right += row * up.dot(from) / (sigma * sigma);
  }
  const Eigen::Vector3d slopes = information.ldlt().solve(right);
  const Eigen::Vector3d normal = (up - slopes.x() * x - slopes.y() * y).normalized();
  return {normal, normal.dot(mean + slopes.z() * up)};
}

double MedianDistance(const Beams& beams, const Eigen::Vector3d& from) {
  std::vector<double> distances;
  for (const RangeRay& ray : beams) distances.push_back((ray.Point() - from).norm());
  return Quantile(std::move(distances), 0.5);
}

/// Whether what lies on the plane stands on something that is seen below it: then it is a level
/// slice through a standing thing.
bool IsSlice(const Beams& on, const Beams& beams, const Plane& plane, double sigma_m) {
  Points below;
  for (const RangeRay& ray : beams) {
    const double deep_m = std::max(3.0 * OnPlaneTolerance(sigma_m, plane, ray), kMinDepth_m);
    const Eigen::Vector3d at = ray.Point();
    const double off_m = plane.Distance(at);
    if (off_m < -deep_m && off_m > -deep_m - kMaxDepth_m)
      below.push_back(at - off_m * plane.normal);
  }
  const auto stands = [&](const RangeRay& ray) {
    const Eigen::Vector3d at = ray.Point() - plane.Distance(ray.Point()) * plane.normal;
    return std::count_if(below.begin(), below.end(), [&](const Eigen::Vector3d& under) {
             return (under - at).squaredNorm() < kSupportRadius_m * kSupportRadius_m;
           }) >= kMinSupportPoints;
  };
  return static_cast<double>(std::count_if(on.begin(), on.end(), stands)) >
         kSliceFraction * static_cast<double>(on.size());
}

/// The extent of what lies on a level plane, without the outermost twentieths.
double DiagonalOf(const Beams& on, const Eigen::Vector3d& up) {
  const Eigen::Vector3d x = up.unitOrthogonal();
  const auto extent = [&](const Eigen::Vector3d& along) {
    std::vector<double> places;
    for (const RangeRay& ray : on) places.push_back(along.dot(ray.Point()));
    return Quantile(places, 0.95) - Quantile(places, 0.05);
  };
  return std::hypot(extent(x), extent(up.cross(x)));
}

struct LevelSurface {
  Plane plane;
  std::size_t points = 0;
  double distance_m = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
};

/// How much less a plane that is tilted counts: tables and what knows which way is up are level to
/// a few degrees.
double WeightOfTilt(const Plane& plane, const TableOptions& options) {
  const double cosine = std::abs(plane.normal.dot(options.up));
  if (cosine < std::cos(options.max_tilt_rad)) return 0.0;
  return std::exp(-0.5 * Squared(std::acos(std::min(1.0, cosine)) / kCountedTilt_rad));
}

/// Level surfaces, the table first: the largest, but not the floor that shows beyond its edge.
std::vector<LevelSurface> LevelSurfaces(const Beams& all, const RaySet& rays,
                                        const TableOptions& options, Random& random) {
  const double sigma_m = rays.sigma_m;
  const auto level = [&](const Plane& plane) { return WeightOfTilt(plane, options); };
  const std::size_t least = std::max<std::size_t>(
      kMinTablePoints,
      static_cast<std::size_t>(kMinTableFraction * static_cast<double>(all.size())));
  std::vector<LevelSurface> found;
  Beams left = all;
  for (int slices = 0; found.size() < kMaxTables && slices <= kMaxSlices;) {
    const auto rough = BestPlane(left, sigma_m, level, random);
    if (!rough) break;
    Beams on = EndingOn(left, *rough, sigma_m);
    if (on.size() < least) break;
    Plane plane = *rough;
    for (int i = 0; i < kRefits && on.size() >= least; ++i) {
      plane = LevelPlane(on, options.up, sigma_m);
      on = EndingOn(left, plane, sigma_m);
    }
    const bool lost = on.size() < least || !(WeightOfTilt(plane, options) > 0.0);
    if (lost) plane = *rough;
    if (lost || IsSlice(on, all, plane, sigma_m) || DiagonalOf(on, options.up) < kLeastWide_m)
      ++slices;
    else
      found.push_back({plane, on.size(), MedianDistance(on, rays.viewpoint), Mean(on)});
    std::erase_if(left, [&](const RangeRay& ray) {
      return std::abs(plane.Distance(ray.Point())) < 1.5 * OnPlaneTolerance(sigma_m, plane, ray);
    });
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const LevelSurface& level_surface : found)
    nearest = std::min(nearest, level_surface.distance_m);
  const auto far = [&](const LevelSurface& it) { return it.distance_m > nearest + kFloorBehind_m; };
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return far(a) != far(b) ? far(b) : a.points > b.points;
  });
  return found;
}

/// The table and what lies lower, there and at a place on the table: a shelf or the floor. Above it
/// a level slab is a cut through what stands there.
std::vector<Plane> TableAndBelow(const Plane& table, const std::vector<LevelSurface>& levels,
                                 const Eigen::Vector3d& place) {
  std::vector<Plane> tables = {table};
  for (const LevelSurface& level : levels)
    if (table.Distance(level.middle) < -kShelfBelow_m &&
        level.plane.Distance(place) > table.Distance(place) + kShelfBelow_m)
      tables.push_back(level.plane);
  return tables;
}

/// Those that end so near to a place, seen from above, thinned where there are many.
Beams EndingNear(const Beams& beams, const Eigen::Vector3d& place, double near_m,
                 const Eigen::Vector3d& up) {
  Beams near;
  for (const RangeRay& ray : beams) {
    const Eigen::Vector3d from = ray.Point() - place;
    if ((from - from.dot(up) * up).norm() < near_m) near.push_back(ray);
  }
  const std::size_t stride = near.size() / kMostNear + 1;
  Beams few;
  for (std::size_t i = 0; i < near.size(); i += stride) few.push_back(near[i]);
  return few;
}

/// Whether most of what ends near a plane ends on it: as much ends beside a slice through upright
/// things.
bool IsLevelOf(const Beams& round, const Plane& plane, double sigma_m) {
  std::ptrdiff_t on = 0, beside = 0;
  for (const RangeRay& ray : round) {
    const double off =
        std::abs(plane.Distance(ray.Point())) / OnPlaneTolerance(sigma_m, plane, ray);
    on += off < 1.0 ? 1 : 0;
    beside += off >= 1.0 && off < kBeside ? 1 : 0;
  }
  return on > beside;
}

/// Whether the thing that the beams `there` see may stand on this plane: enough of them end on it,
/// or their lowest points are a little above it.
bool MayCarry(const Plane& table, const Beams& there, double sigma_m) {
  if (there.empty()) return false;
  if (EndingOn(there, table, sigma_m).size() >= kMinTablePoints) return true;
  std::vector<double> heights;
  for (const RangeRay& ray : there) heights.push_back(table.Distance(ray.Point()));
  const double lowest_m = Quantile(std::move(heights), 0.02);
  return lowest_m > kLeastOver_m && lowest_m < kMostOver_m;
}

}  // namespace

std::vector<Plane> FindTables(const RaySet& region, const Beams& beams, const TableOptions& options,
                              Random& random) {
  if (region.rays.empty()) return {};
  const std::vector<LevelSurface> seen = LevelSurfaces(beams, region, options, random);
  const Eigen::Vector3d middle = PlaceInMiddle(region);
  const RaySet* around = SurroundingBeams(region);
  if (around == nullptr)
    return seen.empty() ? std::vector<Plane>() : TableAndBelow(seen.front().plane, seen, middle);
  const Beams round = EndingNear(around->rays, middle, kSurroundingsRadius_m, options.up);
  const Beams there = EndingNear(beams, middle, kUnderRadius_m, options.up);
  std::vector<LevelSurface> levels = LevelSurfaces(round, *around, options, random);
  levels.insert(levels.end(), seen.begin(), seen.end());
  std::erase_if(levels, [&](const LevelSurface& level) {
    const Beams on = EndingOn(round, level.plane, around->sigma_m);
    return level.plane.Distance(middle) < kLeastOver_m || on.empty() ||
           DiagonalOf(on, options.up) < kLeastWideRound_m ||
           !IsLevelOf(round, level.plane, around->sigma_m) ||
           !MayCarry(level.plane, there, region.sigma_m);
  });
  if (levels.empty()) return {};
  // What is near decides, in the region and of all that is known; but a table hides much of itself
  // and little of the floor before it.
  const Beams near = EndingNear(around->rays, middle, kUnderRadius_m, options.up);
  std::vector<double> beams_on;
  for (const LevelSurface& level : levels)
    beams_on.push_back(WeightOfTilt(level.plane, options) *
                       static_cast<double>(EndingOn(near, level.plane, around->sigma_m).size() +
                                           EndingOn(there, level.plane, region.sigma_m).size()));
  const double least = kHighestFraction * *std::max_element(beams_on.begin(), beams_on.end());
  const Plane* table = nullptr;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (beams_on[i] > 0.0 && beams_on[i] >= least &&
        (table == nullptr || levels[i].plane.Distance(middle) < table->Distance(middle)))
      table = &levels[i].plane;
  return table == nullptr ? std::vector<Plane>() : TableAndBelow(*table, seen, middle);
}

}  // namespace foresight
