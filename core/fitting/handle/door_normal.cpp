#include "core/fitting/handle/door_normal.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/squared.h"

namespace foresight {
namespace {

constexpr std::size_t kLeastAround = 200, kMostAround = 2000;
constexpr double kNear_m = 0.25;     // of the rough door; what is further off is another thing
constexpr double kUneven_m = 0.003;  // no door is a plane
// Of two points that are compared: far enough to tell a slope, near enough to lie on one surface.
constexpr double kLeastBetween_m = 0.06, kMostBetween_m = 0.25;
constexpr int kDraws = 40000;
constexpr std::size_t kMostPairs = 6000, kFewPairs = 600;
constexpr double kFarthestSlope = 0.26;  // 15 deg
constexpr int kSlopeSteps = 6;           // to either side
constexpr int kSlopeRounds = 12;
constexpr double kBin_m = 0.002;
constexpr int kMeanRounds = 3;
constexpr double kOnLevelSigmas = 2.0;

/// Heights of points as a smoothed histogram.
class Levels {
 public:
  /// @param sigma_m what the heights are smoothed by
  explicit Levels(double sigma_m) {
    const int reach = std::max(1, static_cast<int>(std::ceil(3.0 * sigma_m / kBin_m)));
    for (int i = -reach; i <= reach; ++i)
      kernel_.push_back(std::exp(-0.5 * Squared(i * kBin_m / sigma_m)));
    counts_.resize(static_cast<std::size_t>(std::ceil(2.0 * kNear_m / kBin_m)) + 1);
    smooth_.resize(counts_.size());
  }

  void Count(const std::vector<double>& heights_m) {
    std::fill(counts_.begin(), counts_.end(), 0.0);
    for (const double height_m : heights_m) {
      const double bin = std::round((height_m + kNear_m) / kBin_m);
      if (bin >= 0.0 && bin < static_cast<double>(counts_.size()))
        counts_[static_cast<std::size_t>(bin)] += 1.0;
    }
    std::fill(smooth_.begin(), smooth_.end(), 0.0);
    const int reach = static_cast<int>(kernel_.size() / 2), size = static_cast<int>(counts_.size());
    for (int i = 0; i < size; ++i) {
      const double count = counts_[static_cast<std::size_t>(i)];
      if (count == 0.0) continue;
      for (int k = std::max(0, i - reach); k <= std::min(size - 1, i + reach); ++k)
        smooth_[static_cast<std::size_t>(k)] +=
            count * kernel_[static_cast<std::size_t>(k - i + reach)];
    }
  }

  double Highest_m() const {
    const auto at = std::max_element(smooth_.begin(), smooth_.end()) - smooth_.begin();
    return static_cast<double>(at) * kBin_m - kNear_m;
  }

 private:
  std::vector<double> kernel_, counts_, smooth_;
};

/// Points near the rough door, in a frame whose z is its normal, from the middle of the region.
std::vector<Eigen::Vector3d> PointsNear(const RaySet& rays, const Plane& door,
                                        const Eigen::Matrix3d& axes,
                                        const Eigen::Vector3d& middle) {
  const std::size_t step = (rays.rays.size() + kMostAround - 1) / kMostAround;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < rays.rays.size(); i += std::max<std::size_t>(1, step)) {
    const Eigen::Vector3d point = rays.rays[i].Point();
    if (std::abs(door.Distance(point)) < kNear_m)
      points.emplace_back(axes.transpose() * (point - middle));
  }
  return points;
}

/// From one point to another.
using Steps = std::vector<Eigen::Vector3d>;

Steps StepsBetween(const std::vector<Eigen::Vector3d>& points, Random& random) {
  Steps steps;
  const auto any = [&] {
    return static_cast<std::size_t>(random.Index(static_cast<int>(points.size())));
  };
  for (int i = 0; i < kDraws && steps.size() < kMostPairs; ++i) {
    const Eigen::Vector3d step = points[any()] - points[any()];
    const double apart_m = step.head<2>().norm();
    if (apart_m > kLeastBetween_m && apart_m < kMostBetween_m) steps.push_back(step);
  }
  return steps;
}

/// How well slopes explain steps: the sum of exp(-(deviations)^2 / 2).
double Explained(const Steps& steps, std::size_t most, const Eigen::Vector2d& slopes,
                 double sigma_m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(most, steps.size()); ++i)
    sum += std::exp(-0.5 * Squared((steps[i].z() - slopes.dot(steps[i].head<2>())) / sigma_m));
  return sum;
}

/// The slopes that explain most steps between points: those between two surfaces are few, as an
/// edge is a line.
Eigen::Vector2d SlopesOf(const Steps& steps, double sigma_m) {
  // A step of the grid moves the far end of a pair by more than the noise.
  const double grid = kFarthestSlope / kSlopeSteps;
  const double coarse_m = std::hypot(sigma_m, 0.5 * grid * kMostBetween_m);
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = -1.0;
  for (int i = -kSlopeSteps; i <= kSlopeSteps; ++i)
    for (int j = -kSlopeSteps; j <= kSlopeSteps; ++j) {
      const Eigen::Vector2d slopes = grid * Eigen::Vector2d(i, j);
      const double explained = Explained(steps, kFewPairs, slopes, coarse_m);
      if (explained <= most) continue;
      most = explained;
      best = slopes;
    }
  // Least squares again and again, each step weighed by how well it agrees.
  for (int round = 0; round < kSlopeRounds; ++round) {
    const double tolerance_m = round < kSlopeRounds / 3 ? coarse_m : sigma_m;
    Eigen::Matrix2d normal = 1e-9 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const Eigen::Vector3d& step : steps) {
      const double off = (step.z() - best.dot(step.head<2>())) / tolerance_m;
      const double weight = std::exp(-0.5 * Squared(off));
      normal += weight * step.head<2>() * step.head<2>().transpose();
      right += weight * step.z() * step.head<2>();
    }
    best = normal.ldlt().solve(right);
  }
  return best;
}

/// The level that most heights lie on.
double LevelOf(const std::vector<double>& heights_m, double sigma_m) {
  Levels levels(sigma_m);
  levels.Count(heights_m);
  double level_m = levels.Highest_m();
  for (int round = 0; round < kMeanRounds; ++round) {
    double sum_m = 0.0, count = 0.0;
    for (const double height_m : heights_m) {
      if (std::abs(height_m - level_m) > kOnLevelSigmas * sigma_m) continue;
      sum_m += height_m;
      count += 1.0;
    }
    if (count > 0.0) level_m = sum_m / count;
  }
  return level_m;
}

}  // namespace

Plane DoorAmongLevels(const RaySet& around, const RaySet& region, const Plane& rough,
                      Random& random) {
  Eigen::Matrix3d axes;
  axes.col(2) = rough.normal;
  axes.col(0) = rough.normal.unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : region.rays)
    middle += ray.Point() / static_cast<double>(region.rays.size());
  middle -= rough.Distance(middle) * rough.normal;
  const std::vector<Eigen::Vector3d> points = PointsNear(around, rough, axes, middle);
  if (points.size() < kLeastAround) return rough;
  const double sigma_m = std::hypot(around.sigma_m, kUneven_m);
  const Steps steps = StepsBetween(points, random);
  if (steps.size() < kLeastAround) return rough;
  const Eigen::Vector2d slopes = SlopesOf(steps, std::numbers::sqrt2 * sigma_m);
  if (slopes.norm() > kFarthestSlope * std::numbers::sqrt2) return rough;
  const Eigen::Vector3d normal = axes * Eigen::Vector3d(-slopes.x(), -slopes.y(), 1.0).normalized();
  std::vector<double> heights_m;
  for (const Eigen::Vector3d& at : PointsNear(region, rough, axes, middle))
    heights_m.push_back(normal.dot(axes * at));
  return {normal, normal.dot(middle) + LevelOf(heights_m, sigma_m)};
}

}  // namespace foresight
