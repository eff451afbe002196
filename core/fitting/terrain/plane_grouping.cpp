#include "core/fitting/terrain/plane_grouping.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/angles.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr int kMaxDirections = 14;
constexpr double kCone_rad = RadiansFromDegrees(9.0);
constexpr double kNearest_rad = RadiansFromDegrees(14.0);
constexpr int kMeanShifts = 5;
constexpr double kLeastGroupFraction = 0.004;  // of all normals, within a cone
constexpr int kBinsAcross = 61;    // of the tangent plane; 1.7 deg each at 45 deg of tilt
constexpr int kReach = 2;          // cells that a component may jump
constexpr double kFarSteps = 8.0;  // between neighbours seen at a grazing angle, in beam spacings
constexpr double kMinGroupArea_m2 = 0.01;
constexpr double kMergeAngle_rad = RadiansFromDegrees(14.0);
constexpr double kMergeSigmas = 2.5;
constexpr double kMergeFraction = 0.75;
constexpr double kMergeOffset_m = 0.010;
constexpr double kMergeGap_m = 0.06;

/// Where a direction falls on the map of directions around up, in bins.
class DirectionMap {
 public:
  DirectionMap(const Eigen::Vector3d& up, double max_tilt_rad)
      : turn_(RotationBetween(up, Eigen::Vector3d::UnitZ())),
        reach_(std::sin(std::min(1.5, max_tilt_rad + kCone_rad))),
        counts_(Eigen::MatrixXd::Zero(kBinsAcross, kBinsAcross)) {}

  void Add(const Eigen::Vector3d& normal) {
    const Eigen::Vector2i bin = Bin(normal);
    counts_(bin.x(), bin.y()) += 1.0;
  }

  /// A direction in the middle of the fullest 3 x 3 bins.
  Eigen::Vector3d Fullest() const {
    double most = -1.0;
    Eigen::Vector2i at(0, 0);
    for (int x = 1; x + 1 < kBinsAcross; ++x)
      for (int y = 1; y + 1 < kBinsAcross; ++y) {
        const double count = counts_.block<3, 3>(x - 1, y - 1).sum();
        if (count > most) {
          most = count;
          at = {x, y};
        }
      }
    const Eigen::Vector2d flat =
        ((at.cast<double>() + Eigen::Vector2d::Constant(0.5)) / kBinsAcross * 2.0 -
         Eigen::Vector2d::Ones()) *
        reach_;
    const Eigen::Vector3d seen(flat.x(), flat.y(),
                               std::sqrt(std::max(0.0, 1.0 - flat.squaredNorm())));
    return turn_.conjugate() * seen;
  }

 private:
  Eigen::Vector2i Bin(const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d seen = turn_ * normal;
    const Eigen::Vector2d flat = (seen.head<2>() / reach_ + Eigen::Vector2d::Ones()) * 0.5;
    return (flat * kBinsAcross).cast<int>().cwiseMax(0).cwiseMin(kBinsAcross - 1);
  }

  Eigen::Quaterniond turn_;
  double reach_;
  Eigen::MatrixXd counts_;
};

/// Index of the direction nearest to a normal, within kNearest_rad; -1 = none.
int NearestDirection(const Eigen::Vector3d& normal,
                     const std::vector<Eigen::Vector3d>& directions) {
  int best = -1;
  double most = std::cos(kNearest_rad);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double along = normal.dot(directions[k]);
    if (!(along > most)) continue;
    most = along;
    best = static_cast<int>(k);
  }
  return best;
}

/// Grows one component from a point; the members get `label`.
int Grow(const SurfaceGrid& grid, const std::vector<int>& direction,
         const std::vector<Eigen::Vector3d>& directions, int start, int label,
         std::vector<int>& labels) {
  const double gate_m = std::max(0.020, 2.0 * grid.sigma_m());
  const double far_steps = kFarSteps * grid.step_rad().maxCoeff();
  const int k = direction[static_cast<std::size_t>(start)];
  const Eigen::Vector3d& normal = directions[static_cast<std::size_t>(k)];
  std::vector<int> front = {start};
  labels[static_cast<std::size_t>(start)] = label;
  int members = 0;
  while (!front.empty()) {
    const int i = front.back();
    front.pop_back();
    ++members;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        if (dx != 0 && dy != 0) continue;
        const int j = grid.Neighbor(i, dx, dy);
        if (j < 0 || labels[static_cast<std::size_t>(j)] >= 0 ||
            direction[static_cast<std::size_t>(j)] != k)
          continue;
        const Eigen::Vector3d step = grid[j].point - grid[i].point;
        if (std::abs(step.dot(normal)) > gate_m ||
            step.norm() > std::max(4.0 * gate_m, far_steps * grid[i].range_m))
          continue;
        labels[static_cast<std::size_t>(j)] = label;
        front.push_back(j);
      }
  }
  return members;
}

/// Gap between the balls around two planes' points, as if each were a square.
double GapBetween(const SurfacePlane& a, const SurfacePlane& b) {
  return (a.center - b.center).norm() - 0.5 * (std::sqrt(a.area_m2) + std::sqrt(b.area_m2));
}

/// Whether most of a part's own points lie on a larger plane. The direction of a narrow part is
/// known too badly to be asked for more than a rough agreement.
bool LiesOn(const SurfaceGrid& grid, const std::vector<int>& points, const SurfacePlane& part,
            const SurfacePlane& larger) {
  if (GapBetween(part, larger) > kMergeGap_m ||
      part.plane.normal.dot(larger.plane.normal) < std::cos(kMergeAngle_rad))
    return false;
  int near = 0;
  double sum = 0.0;
  for (const int i : points) {
    const double off = larger.plane.Distance(grid[i].point);
    sum += off;
    near += std::abs(off) < kMergeSigmas * DistanceSigma(grid, i, larger.plane) ? 1 : 0;
  }
  const auto count = static_cast<double>(points.size());
  return near > kMergeFraction * count &&
         std::abs(sum / count) < std::max(kMergeOffset_m, 0.8 * grid.sigma_m());
}

}  // namespace

std::vector<Eigen::Vector3d> FrequentDirections(std::span<const Eigen::Vector3d> normals,
                                                const Eigen::Vector3d& up, double max_tilt_rad) {
  std::vector<Eigen::Vector3d> left;
  for (const Eigen::Vector3d& normal : normals)
    if (normal.allFinite() && normal.dot(up) > std::cos(max_tilt_rad + kCone_rad))
      left.push_back(normal);
  const double least = std::max(6.0, kLeastGroupFraction * static_cast<double>(left.size()));
  std::vector<Eigen::Vector3d> directions;
  while (static_cast<int>(directions.size()) < kMaxDirections &&
         static_cast<double>(left.size()) >= least) {
    DirectionMap map(up, max_tilt_rad);
    for (const Eigen::Vector3d& normal : left) map.Add(normal);
    Eigen::Vector3d mode = map.Fullest();
    double members = 0.0;
    for (int shift = 0; shift < kMeanShifts; ++shift) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      members = 0.0;
      for (const Eigen::Vector3d& normal : left) {
        if (normal.dot(mode) < std::cos(kCone_rad)) continue;
        sum += normal;
        members += 1.0;
      }
      if (members > 0.0) mode = sum.normalized();
    }
    if (members < least) break;
    if (mode.dot(up) > std::cos(max_tilt_rad)) directions.push_back(mode);
    std::erase_if(left,
                  [&](const auto& normal) { return normal.dot(mode) >= std::cos(kCone_rad); });
  }
  return directions;
}

void MergeParts(const SurfaceGrid& grid, double min_area_m2, SurfacePlanes& surfaces) {
  const std::size_t count = surfaces.planes.size();
  std::vector<std::vector<int>> points(count);
  for (int i = 0; i < grid.size(); ++i)
    if (const int label = surfaces.labels[static_cast<std::size_t>(i)]; label >= 0)
      points[static_cast<std::size_t>(label)].push_back(i);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return surfaces.planes[a].area_m2 > surfaces.planes[b].area_m2;
  });
  std::vector<int> target(count);
  for (std::size_t a = 0; a < count; ++a) {
    target[order[a]] = static_cast<int>(order[a]);
    for (std::size_t b = 0; b < a; ++b) {
      const std::size_t part = order[a], larger = order[b];
      if (target[larger] != static_cast<int>(larger) ||
          !LiesOn(grid, points[part], surfaces.planes[part], surfaces.planes[larger]))
        continue;
      target[part] = static_cast<int>(larger);
      break;
    }
  }
  for (int& label : surfaces.labels)
    if (label >= 0) label = target[static_cast<std::size_t>(label)];
  RefitPlanes(grid, min_area_m2, surfaces);
}

SurfacePlanes GroupPlanes(const SurfaceGrid& grid, std::span<const Eigen::Vector3d> normals,
                          const Eigen::Vector3d& up, double max_tilt_rad) {
  const std::vector<Eigen::Vector3d> directions = FrequentDirections(normals, up, max_tilt_rad);
  const auto count = static_cast<std::size_t>(grid.size());
  std::vector<int> direction(count, -1);
  for (std::size_t i = 0; i < count; ++i)
    if (normals[i].allFinite()) direction[i] = NearestDirection(normals[i], directions);

  SurfacePlanes surfaces;
  surfaces.labels.assign(count, -1);
  std::vector<int> members;
  for (int i = 0; i < grid.size(); ++i)
    if (direction[static_cast<std::size_t>(i)] >= 0 &&
        surfaces.labels[static_cast<std::size_t>(i)] < 0)
      members.push_back(
          Grow(grid, direction, directions, i, static_cast<int>(members.size()), surfaces.labels));
  surfaces.planes.resize(members.size());
  RefitPlanes(grid, kMinGroupArea_m2, surfaces);
  MergeParts(grid, kMinGroupArea_m2, surfaces);
  return surfaces;
}

}  // namespace foresight
