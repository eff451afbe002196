#include "core/fitting/valve/rim_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/fitting/best_distinct.h"

namespace foresight {
namespace {

constexpr int kRimBins = 24;              // of the rim's circle
constexpr double kPenaltyOutside = 0.15;  // a rim is the outermost part of a wheel

/// The circle through three points, its axis across their plane.
std::optional<RimHypothesis> CircleThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                           const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  if (area2 < 1e-10) return std::nullopt;
  const Eigen::Vector3d to_center =
      (ac.squaredNorm() * normal.cross(ab) - ab.squaredNorm() * normal.cross(ac)) / (2.0 * area2);
  return RimHypothesis{a + to_center, normal / std::sqrt(area2), to_center.norm(), 0.0};
}

/// The same with a given axis: the points are first pushed onto one plane across it.
std::optional<RimHypothesis> CircleThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                           const Eigen::Vector3d& c, const Eigen::Vector3d& axis) {
  const double level = axis.dot(a + b + c) / 3.0;
  const auto onto = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return p + (level - axis.dot(p)) * axis;
  };
  auto circle = CircleThrough(onto(a), onto(b), onto(c));
  if (circle) circle->axis = axis;
  return circle;
}

double Score(std::span<const Eigen::Vector3d> points, const RimHypothesis& rim, double tolerance) {
  const Eigen::Vector3d x = rim.axis.unitOrthogonal();
  const Eigen::Vector3d y = rim.axis.cross(x);
  std::bitset<kRimBins> covered;
  double support = 0.0;
  int outside = 0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d q = point - rim.center;
    const double height = q.dot(rim.axis);
    if (std::abs(height) > 3.0 * tolerance) continue;
    const double radial = std::sqrt(std::max(0.0, q.squaredNorm() - height * height));
    const double off = radial - rim.radius_m;
    if (off > 2.0 * tolerance) ++outside;
    const double ratio = (off * off + height * height) / (tolerance * tolerance);
    if (ratio >= 1.0) continue;
    support += 1.0 - ratio;
    const double turn = std::atan2(q.dot(y), q.dot(x)) / (2.0 * std::numbers::pi) + 0.5;
    covered.set(
        static_cast<std::size_t>(std::clamp(static_cast<int>(turn * kRimBins), 0, kRimBins - 1)));
  }
  return support * static_cast<double>(covered.count()) / kRimBins - kPenaltyOutside * outside;
}

bool SimilarRims(const RimHypothesis& a, const RimHypothesis& b) {
  const double scale = 0.15 * std::max(a.radius_m, b.radius_m);
  return (a.center - b.center).norm() < scale && std::abs(a.radius_m - b.radius_m) < scale &&
         a.axis.dot(b.axis) > std::cos(0.25);
}

}  // namespace

std::vector<RimHypothesis> FindRims(std::span<const Eigen::Vector3d> points,
                                    const RimSearchOptions& options, Random& random) {
  const int count = static_cast<int>(points.size());
  if (count < 3) return {};
  const double min_cosine = std::cos(options.max_tilt_rad);
  std::vector<RimHypothesis> found;
  for (int trial = 0; trial < options.trials; ++trial) {
    const Eigen::Vector3d& a = points[random.Index(count)];
    const Eigen::Vector3d& b = points[random.Index(count)];
    const Eigen::Vector3d& c = points[random.Index(count)];
    auto rim = trial % 2 == 0 ? CircleThrough(a, b, c, options.facing) : CircleThrough(a, b, c);
    if (!rim || rim->radius_m < options.min_radius_m || rim->radius_m > options.max_radius_m)
      continue;
    if (rim->axis.dot(options.facing) < 0.0) rim->axis = -rim->axis;
    if (rim->axis.dot(options.facing) < min_cosine) continue;
    rim->score = Score(points, *rim, options.tolerance_m);
    if (rim->score > 0.0) found.push_back(*rim);
  }
  KeepBestDistinct(static_cast<std::size_t>(options.keep), &RimHypothesis::score, SimilarRims,
                   found);
  return found;
}

}  // namespace foresight
