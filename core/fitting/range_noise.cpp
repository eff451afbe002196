#include "core/fitting/range_noise.h"

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

/// The second difference of a range and those of two neighbours on opposite sides, as on a grid's
/// line; NaN where no two lie so.
double SecondDifferenceAt(const std::vector<RangeRay>& rays, std::size_t i) {
  constexpr double kOpposite = 0.3;  // of the way to a neighbour
  const std::vector<std::size_t> neighbours = NearestInDirection(rays, i);
  double best = std::numeric_limits<double>::infinity();
  double difference = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t a : neighbours) {
    const Eigen::Vector3d to_a = rays[a].direction - rays[i].direction;
    for (const std::size_t b : neighbours) {
      const Eigen::Vector3d to_b = rays[b].direction - rays[i].direction;
      const double off = (to_a + to_b).norm() / to_a.norm();
      if (off > kOpposite || to_a.norm() + off * to_a.norm() >= best) continue;
      best = to_a.norm() + off * to_a.norm();
      difference = std::abs(rays[a].range_m - 2.0 * rays[i].range_m + rays[b].range_m);
    }
  }
  return difference;
}

/// |second differences| of rays without a grid, sorted.
std::vector<double> ScatteredSecondDifferences(const std::vector<RangeRay>& rays) {
  std::vector<double> differences;
  const std::size_t step = std::max<std::size_t>(1, rays.size() / kAsked);
  for (std::size_t i = 0; i < rays.size(); i += step)
    if (const double difference = SecondDifferenceAt(rays, i); std::isfinite(difference))
      differences.push_back(difference);
  std::sort(differences.begin(), differences.end());
  return differences;
}

}  // namespace

double EstimateRangeSigma(const RaySet& rays) {
  const int apart = std::max(
      1,
      static_cast<int>(std::lround(1.0 / std::sqrt(std::clamp(rays.samples_per_ray, 0.01, 1.0)))));
  const FloatImage grid = RangeGrid(rays);
  const std::vector<double> differences =
      grid.empty() ? ScatteredSecondDifferences(rays.rays) : SecondDifferences(grid, apart);
  if (std::ssize(differences) < kMinTriples) return std::numeric_limits<double>::quiet_NaN();
  return std::clamp(TrimmedDeviation(differences) / kSecondDifference, kLeastRangeSigma_m,
                    kLargestRangeSigma_m);
}

}  // namespace foresight
