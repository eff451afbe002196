#include "core/fitting/valve/lever_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/fitting/best_distinct.h"

namespace foresight {
namespace {

constexpr double kMinLength_m = 0.08;
constexpr double kMaxLength_m = 0.42;
constexpr int kMinPoints = 8;
constexpr double kLeverStartTubeRadius_m = 0.012;

/// A piece of a straight line with the points that lie along it.
struct Bar {
  Eigen::Vector3d begin;
  Eigen::Vector3d direction;
  double length_m = 0.0;
  int points = 0;
};

/// The run of points along a line that has most of them without a gap.
Bar LongestRun(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& through,
               const Eigen::Vector3d& direction, const LeverSearchOptions& options) {
  std::vector<double> along;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d offset = point - through;
    const double at = offset.dot(direction);
    if ((offset - at * direction).squaredNorm() < options.tolerance_m * options.tolerance_m)
      along.push_back(at);
  }
  std::sort(along.begin(), along.end());
  Bar best{through, direction, 0.0, 0};
  std::size_t first = 0;
  for (std::size_t i = 1; i <= along.size(); ++i) {
    if (i < along.size() && along[i] - along[i - 1] <= options.max_gap_m) continue;
    const int count = static_cast<int>(i - first);
    if (count > best.points)
      best = {through + along[first] * direction, direction, along[i - 1] - along[first], count};
    first = i;
  }
  return best;
}

bool SimilarBars(const Bar& a, const Bar& b) {
  const Eigen::Vector3d middle_a = a.begin + 0.5 * a.length_m * a.direction;
  const Eigen::Vector3d middle_b = b.begin + 0.5 * b.length_m * b.direction;
  return (middle_a - middle_b).norm() < 0.06 && std::abs(a.direction.dot(b.direction)) > 0.97;
}

ValveCandidate LeverFrom(const Eigen::Vector3d& pivot, const Eigen::Vector3d& direction,
                         double length_m, const Eigen::Vector3d& facing) {
  const Eigen::Vector3d z = (facing - facing.dot(direction) * direction).normalized();
  Eigen::Matrix3d rotation;
  rotation << direction, z.cross(direction), z;
  // The returns come from the front of the bar; its middle lies a radius further back.
  return {Rigid<frame::Base, frame::Object>(rotation, pivot - kLeverStartTubeRadius_m * z),
          UsualLever(length_m, kLeverStartTubeRadius_m), 0.0};
}

}  // namespace

std::vector<ValveCandidate> FindLevers(const std::vector<Eigen::Vector3d>& points,
                                       const LeverSearchOptions& options, Random& random) {
  const int count = static_cast<int>(points.size());
  if (count < kMinPoints) return {};
  std::vector<Bar> bars;
  for (int trial = 0; trial < options.trials; ++trial) {
    const Eigen::Vector3d& a = points[static_cast<std::size_t>(random.Index(count))];
    const Eigen::Vector3d& b = points[static_cast<std::size_t>(random.Index(count))];
    const double apart = (b - a).norm();
    if (apart < kMinLength_m || apart > kMaxLength_m) continue;
    const Eigen::Vector3d direction = (b - a) / apart;
    if (std::abs(direction.dot(options.facing)) > 0.7) continue;
    const Bar bar = LongestRun(points, a, direction, options);
    if (bar.points >= kMinPoints && bar.length_m > kMinLength_m && bar.length_m < kMaxLength_m)
      bars.push_back(bar);
  }
  KeepBestDistinct(static_cast<std::size_t>(options.keep), &Bar::points, SimilarBars, bars);
  std::vector<ValveCandidate> levers;
  for (const Bar& bar : bars) {
    const double length_m = std::max(kMinLength_m, bar.length_m - 2.0 * kLeverStartTubeRadius_m);
    const Eigen::Vector3d inset = kLeverStartTubeRadius_m * bar.direction;
    const Eigen::Vector3d end = bar.begin + bar.length_m * bar.direction;
    levers.push_back(LeverFrom(bar.begin + inset, bar.direction, length_m, options.facing));
    levers.push_back(LeverFrom(end - inset, -bar.direction, length_m, options.facing));
  }
  return levers;
}

}  // namespace foresight
