#include "core/fitting/cylinder/cylinder_search.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/quantile.h"
#include "core/fitting/best_distinct.h"

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kDirections = 40;  // about 20 deg apart on half a sphere
constexpr int kTrials = 120;     // circles in each
constexpr int kLikelyTrials = 400;
constexpr std::size_t kKept = 8;
constexpr std::size_t kLeastOn = 12;
constexpr double kLow = 0.02, kHigh = 0.98;  // of the points along the axis

/// Directions of half a sphere, evenly.
Points EvenDirections() {
  Points directions;
  for (int i = 0; i < kDirections; ++i) {
    const double z = (i + 0.5) / kDirections;
    const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return directions;
}

Points MainDirections(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) spread += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  return {solver.eigenvectors().col(2), solver.eigenvectors().col(1)};
}

/// Middle and radius of the circle through three points of a plane; nullopt where they are in line.
struct Circle {
  Eigen::Vector2d middle;
  double radius_m;
};
std::optional<Circle> CircleThrough(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                    const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, ac = c - a;
  const double area2 = 2.0 * (ab.x() * ac.y() - ab.y() * ac.x());
  if (std::abs(area2) < 1e-9) return std::nullopt;
  const double ab2 = ab.squaredNorm(), ac2 = ac.squaredNorm();
  const Eigen::Vector2d middle((ac.y() * ab2 - ab.y() * ac2) / area2,
                               (ab.x() * ac2 - ac.x() * ab2) / area2);
  return Circle{a + middle, middle.norm()};
}

/// One direction's view of the points.
class CirclesAlong {
 public:
  CirclesAlong(const Points& points, const Eigen::Vector3d& axis, const Eigen::Vector3d& viewer,
               const CylinderBounds& bounds, double tolerance_m)
      : points_(points), axis_(axis), bounds_(bounds), tolerance_m_(tolerance_m) {
    x_ = axis.unitOrthogonal();
    y_ = axis.cross(x_);
    for (const Eigen::Vector3d& point : points) flat_.emplace_back(x_.dot(point), y_.dot(point));
    viewer_ = {x_.dot(viewer), y_.dot(viewer)};
  }

  std::optional<CylinderState> Draw(Random& random) const {
    const int count = static_cast<int>(std::ssize(flat_));
    const auto at = [&](int i) { return flat_[static_cast<std::size_t>(i)]; };
    const Eigen::Vector2d a = at(random.Index(count));
    Eigen::Vector2d others[2];
    for (Eigen::Vector2d& other : others) {
      // Near enough for the largest circle, or the draw is lost.
      other = at(random.Index(count));
      if ((other - a).norm() > 2.0 * bounds_.max_radius_m) return std::nullopt;
    }
    const auto circle = CircleThrough(a, others[0], others[1]);
    if (!circle || circle->radius_m < bounds_.min_radius_m ||
        circle->radius_m > bounds_.max_radius_m)
      return std::nullopt;
    // What is seen of it lies before its middle.
    const Eigen::Vector2d to_viewer = (viewer_ - circle->middle).normalized();
    const Eigen::Vector2d middle = (a + others[0] + others[1]) / 3.0 - circle->middle;
    if (middle.dot(to_viewer) < 0.0) return std::nullopt;
    return WithEnds(*circle);
  }

 private:
  /// As long as the points that lie on it reach.
  std::optional<CylinderState> WithEnds(const Circle& circle) const {
    std::vector<double> along;
    for (std::size_t i = 0; i < flat_.size(); ++i)
      if (std::abs((flat_[i] - circle.middle).norm() - circle.radius_m) < tolerance_m_)
        along.push_back(axis_.dot(points_[i]));
    if (along.size() < kLeastOn) return std::nullopt;
    const auto quantile = [&](double fraction) {
      return MoveToRank(along,
                        static_cast<std::size_t>(fraction * static_cast<double>(along.size() - 1)));
    };
    const double low = quantile(kLow), high = quantile(kHigh);
    CylinderState cylinder;
    cylinder.axis = axis_;
    cylinder.radius_m = circle.radius_m;
    cylinder.length_m = std::max(high - low, circle.radius_m);
    cylinder.middle = circle.middle.x() * x_ + circle.middle.y() * y_ + 0.5 * (low + high) * axis_;
    return cylinder;
  }

  const Points& points_;
  Eigen::Vector3d axis_, x_, y_;
  CylinderBounds bounds_;
  double tolerance_m_;
  std::vector<Eigen::Vector2d> flat_;
  Eigen::Vector2d viewer_;
};

bool AlikeCylinders(const CylinderState& a, const CylinderState& b) {
  const double apart_m = std::max(0.5 * (a.radius_m + b.radius_m), 0.02);
  return std::abs(a.axis.dot(b.axis)) > 0.97 && a.FromAxis(b.middle).norm() < apart_m &&
         std::abs(a.radius_m - b.radius_m) < 0.5 * apart_m;
}

std::vector<CylinderState> BestOf(std::vector<CylinderState> cylinders) {
  KeepBestDistinct(kKept, &CylinderState::score, AlikeCylinders, cylinders);
  return cylinders;
}

}  // namespace

std::vector<CylinderState> FindCylinders(const BeamLikelihood& likelihood, const Points& points,
                                         const Eigen::Vector3d& up, const CylinderBounds& bounds,
                                         Random& random) {
  std::vector<CylinderState> found;
  if (points.size() < kLeastOn) return found;
  const double tolerance_m = 2.0 * likelihood.rays().sigma_m + 0.005;
  const auto look_along = [&](const Eigen::Vector3d& axis, int trials) {
    const CirclesAlong circles(points, axis, likelihood.rays().viewpoint, bounds, tolerance_m);
    for (int trial = 0; trial < trials; ++trial) {
      auto cylinder = circles.Draw(random);
      if (!cylinder) continue;
      cylinder->score = ScoreOf(*cylinder, likelihood, bounds);
      if (std::isfinite(cylinder->score)) found.push_back(*cylinder);
    }
  };
  look_along(up, kLikelyTrials);
  for (const Eigen::Vector3d& axis : MainDirections(points)) look_along(axis, kLikelyTrials);
  for (const Eigen::Vector3d& axis : EvenDirections()) look_along(axis, kTrials);
  return BestOf(std::move(found));
}

}  // namespace foresight
