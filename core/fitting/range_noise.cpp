#include "core/fitting/range_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/image.h"

namespace foresight {
namespace {

constexpr int kMinTriples = 40;
constexpr int kRounds = 12;
// An edge of a tube or a wall is several sigmas high: what lies beyond this many is one.
constexpr double kEdge_sigmas = 2.5;
// Of |z| for a normal z: the quarter quantile, and the median of those below kEdge_sigmas.
constexpr double kQuarterOfNormal = 0.3186;
constexpr double kMedianOfTrimmed = 0.6640;
// r1 - 2 r2 + r3 of independent ranges has this many times their deviation.
constexpr double kSecondDifference = 2.449489742783178;

/// Ranges on the grid they were measured on, NaN between them. Empty for a cloud without a grid.
FloatImage RangeGrid(const RaySet& set) {
  Eigen::Vector2i low = Eigen::Vector2i::Constant(std::numeric_limits<int>::max());
  Eigen::Vector2i high = Eigen::Vector2i::Constant(-1);
  for (const RangeRay& ray : set.rays) {
    if ((ray.cell.array() < 0).any()) return {};
    low = low.cwiseMin(ray.cell);
    high = high.cwiseMax(ray.cell);
  }
  if ((high.array() < low.array()).any()) return {};
  FloatImage grid(high.x() - low.x() + 1, high.y() - low.y() + 1,
                  std::numeric_limits<float>::quiet_NaN());
  for (const RangeRay& ray : set.rays)
    grid(ray.cell.x() - low.x(), ray.cell.y() - low.y()) = static_cast<float>(ray.range_m);
  return grid;
}

/// |second differences| of ranges `apart` cells from each other along a line, sorted.
std::vector<double> SecondDifferences(const FloatImage& grid, int apart) {
  std::vector<double> differences;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = apart; x + apart < grid.width(); ++x) {
      const double difference =
          static_cast<double>(grid(x - apart, y)) - 2.0 * grid(x, y) + grid(x + apart, y);
      if (std::isfinite(difference)) differences.push_back(std::abs(difference));
    }
  }
  std::sort(differences.begin(), differences.end());
  return differences;
}

/// Deviation of the normal part of sorted absolute values, most of the rest being larger.
double TrimmedDeviation(const std::vector<double>& sorted) {
  double deviation = sorted[sorted.size() / 4] / kQuarterOfNormal;
  for (int round = 0; round < kRounds; ++round) {
    const auto edge = std::upper_bound(sorted.begin(), sorted.end(), kEdge_sigmas * deviation);
    if (edge == sorted.begin()) break;
    deviation = sorted[static_cast<std::size_t>(edge - sorted.begin()) / 2] / kMedianOfTrimmed;
  }
  return deviation;
}

constexpr std::size_t kAsked = 400;
constexpr int kNeighbours = 8;
constexpr double kSameDirection = 1e-12;  // of squared chords

/// The rays that are nearest in direction, but for those of the same direction.
std::vector<std::size_t> NearestInDirection(const std::vector<RangeRay>& rays, std::size_t to) {
  std::vector<std::pair<double, std::size_t>> nearest;
  nearest.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double chord2 = (rays[i].direction - rays[to].direction).squaredNorm();
    if (chord2 > kSameDirection) nearest.emplace_back(chord2, i);
  }
  const std::size_t count = std::min<std::size_t>(kNeighbours, nearest.size());
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count),
                    nearest.end());
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < count; ++i) found.push_back(nearest[i].second);
  return found;
}

/// By how much a range differs from the plane through its neighbours, divided by what the noise of
/// all of them makes of one sigma; NaN where they make no plane.
double OffItsNeighbours(const std::vector<RangeRay>& rays, std::size_t i) {
  const std::vector<std::size_t> neighbours = NearestInDirection(rays, i);
  if (neighbours.size() < kNeighbours) return std::numeric_limits<double>::quiet_NaN();
  // A plane is linear in inverse range over the tangents of the direction.
  const Eigen::Vector3d x = rays[i].direction.unitOrthogonal(), y = rays[i].direction.cross(x);
  Eigen::Matrix<double, kNeighbours, 3> design;
  Eigen::Matrix<double, kNeighbours, 1> inverse_range;
  for (int k = 0; k < kNeighbours; ++k) {
    const RangeRay& ray = rays[neighbours[static_cast<std::size_t>(k)]];
    const double ahead = ray.direction.dot(rays[i].direction);
    if (!(ahead > 0.5)) return std::numeric_limits<double>::quiet_NaN();
    design.row(k) << 1.0, ray.direction.dot(x) / ahead, ray.direction.dot(y) / ahead;
    inverse_range(k) = 1.0 / (ray.range_m * ahead);
  }
  const Eigen::Matrix3d normal = design.transpose() * design;
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-9))
    return std::numeric_limits<double>::quiet_NaN();  // in one line
  const double predicted = solver.solve(design.transpose() * inverse_range).x();
  if (!(predicted > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const double leverage = solver.solve(Eigen::Vector3d::UnitX()).x();
  return std::abs(rays[i].range_m - 1.0 / predicted) / std::sqrt(1.0 + leverage);
}

/// Of rays without a grid: differences to the planes of their neighbours, sorted.
std::vector<double> PlaneDifferences(const std::vector<RangeRay>& rays) {
  std::vector<double> differences;
  const std::size_t step = std::max<std::size_t>(1, rays.size() / kAsked);
  for (std::size_t i = 0; i < rays.size(); i += step)
    if (const double difference = OffItsNeighbours(rays, i); std::isfinite(difference))
      differences.push_back(difference);
  std::sort(differences.begin(), differences.end());
  return differences;
}

double Bounded(double sigma_m) {
  return std::clamp(sigma_m, kLeastRangeSigma_m, kLargestRangeSigma_m);
}

}  // namespace

double EstimateRangeSigma(const RaySet& rays) {
  const FloatImage grid = RangeGrid(rays);
  if (grid.empty() && !rays.rays.empty()) {
    const std::vector<double> differences = PlaneDifferences(rays.rays);
    if (std::ssize(differences) < kMinTriples) return std::numeric_limits<double>::quiet_NaN();
    return Bounded(TrimmedDeviation(differences));
  }
  const int apart = std::max(
      1,
      static_cast<int>(std::lround(1.0 / std::sqrt(std::clamp(rays.samples_per_ray, 0.01, 1.0)))));
  const std::vector<double> differences = SecondDifferences(grid, apart);
  if (std::ssize(differences) < kMinTriples) return std::numeric_limits<double>::quiet_NaN();
  return Bounded(TrimmedDeviation(differences) / kSecondDifference);
}

}  // namespace foresight
