#include "core/fitting/drill/alternative_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/quantile.h"
#include "core/fitting/solids/pattern_search.h"
#include "core/fitting/solids/solid_coverage.h"

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kReach_m = 0.22;  // of points round the place
constexpr int kCylinderParameters = 4;
constexpr int kBoxParameters = 7;
constexpr double kLeastSize_m = 0.008;
constexpr double kUsualDepth_m = 0.08;       // of a box whose back is not seen
constexpr double kLow = 0.03, kHigh = 0.97;  // quantiles: a few points are always astray

/// x, y, radius, height; upright on the table.
SolidPart CylinderOf(const Eigen::VectorXd& v) {
  SolidPart part;
  part.shape = SolidPart::Shape::kCylinder;
  part.size_m = {2.0 * v[2], 2.0 * v[2], v[3]};
  part.object_from_part = {Eigen::Quaterniond::Identity(), {v[0], v[1], 0.5 * v[3]}};
  return part;
}

/// x, y, middle's height, yaw, width, depth, height.
SolidPart BoxOf(const Eigen::VectorXd& v) {
  SolidPart part;
  part.shape = SolidPart::Shape::kBox;
  part.size_m = v.segment<3>(4);
  part.object_from_part = {Eigen::Quaterniond(Eigen::AngleAxisd(v[3], Eigen::Vector3d::UnitZ())),
                           v.head<3>()};
  return part;
}

bool Real(const SolidPart& part) {
  return part.size_m.minCoeff() >= kLeastSize_m && part.size_m.maxCoeff() < 1.0;
}

struct Span {
  double low = 0.0;
  double high = 0.0;
  double Middle() const { return 0.5 * (low + high); }
  double Length() const { return high - low; }
};

Span SpanAlong(const Points& points, const Eigen::Vector3d& along) {
  std::vector<double> values;
  for (const Eigen::Vector3d& point : points) values.push_back(along.dot(point));
  return {Quantile(values, kLow), Quantile(values, kHigh)};
}

/// A box round points, its front where they are, turned so that it is narrowest.
Eigen::VectorXd BoxRound(const Points& points, const Eigen::Vector2d& viewer) {
  Eigen::VectorXd best(kBoxParameters);
  double least = std::numeric_limits<double>::infinity();
  const Span height = SpanAlong(points, Eigen::Vector3d::UnitZ());
  for (int i = 0; i < 9; ++i) {
    const double yaw = 0.5 * std::numbers::pi * i / 9;
    const Eigen::Vector3d x(std::cos(yaw), std::sin(yaw), 0.0), y(-x.y(), x.x(), 0.0);
    const Span across = SpanAlong(points, x), along = SpanAlong(points, y);
    const double area = across.Length() * along.Length();
    if (!(area < least)) continue;
    least = area;
    const double width = std::max(across.Length(), 0.02), depth = std::max(along.Length(), 0.02);
    Eigen::Vector3d middle = across.Middle() * x + along.Middle() * y;
    best << middle.x(), middle.y(), height.Middle(), yaw, width, depth,
        std::max(height.Length(), 0.02);
  }
  // Seen from the front alone it is thin: give it a depth, away from the viewer.
  for (const int side : {4, 5}) {
    if (best[side] > 0.5 * kUsualDepth_m) continue;
    const Eigen::Vector2d away = (best.head<2>() - viewer).normalized();
    best.head<2>() += 0.5 * (kUsualDepth_m - best[side]) * away;
    best[side] = kUsualDepth_m;
  }
  return best;
}

Eigen::VectorXd CylinderRound(const Points& points, const Eigen::Vector2d& viewer) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& point : points) mean += point.head<2>();
  mean /= static_cast<double>(points.size());
  const Eigen::Vector2d away = (mean - viewer).normalized();
  const double width = SpanAlong(points, {-away.y(), away.x(), 0.0}).Length();
  const double radius = std::clamp(0.5 * width, 0.015, 0.15);
  Eigen::VectorXd v(kCylinderParameters);
  v << mean.x() + 0.6 * radius * away.x(), mean.y() + 0.6 * radius * away.y(), radius,
      SpanAlong(points, Eigen::Vector3d::UnitZ()).high;
  return v;
}

void AppendStep(std::vector<Eigen::VectorXd>& steps, Eigen::Index size, Eigen::Index at,
                double length) {
  steps.push_back(length * Eigen::VectorXd::Unit(size, at));
}

/// Steps of a cylinder's or box's parameters; a box's faces move one by one too.
void AppendCylinderSteps(std::vector<Eigen::VectorXd>& steps, Eigen::Index size, Eigen::Index at) {
  for (const int i : {0, 1}) AppendStep(steps, size, at + i, 0.012);
  AppendStep(steps, size, at + 2, 0.008);
  AppendStep(steps, size, at + 3, 0.025);
}
void AppendBoxSteps(std::vector<Eigen::VectorXd>& steps, Eigen::Index size, Eigen::Index at,
                    double yaw) {
  for (const int i : {0, 1, 2}) AppendStep(steps, size, at + i, 0.012);
  AppendStep(steps, size, at + 3, 0.15);
  const Eigen::Vector3d sides[3] = {{std::cos(yaw), std::sin(yaw), 0.0},
                                    {-std::sin(yaw), std::cos(yaw), 0.0},
                                    Eigen::Vector3d::UnitZ()};
  for (int i = 0; i < 3; ++i)
    for (const double way : {1.0, -1.0}) {
      Eigen::VectorXd step = 0.024 * Eigen::VectorXd::Unit(size, at + 4 + i);
      step.segment<3>(at) = 0.012 * way * sides[i];
      steps.push_back(step);
    }
}

enum class Kind { kCylinder, kBox, kBoth };

std::vector<SolidPart> PartsOf(Kind kind, const Eigen::VectorXd& v) {
  if (kind == Kind::kCylinder) return {CylinderOf(v)};
  if (kind == Kind::kBox) return {BoxOf(v)};
  return {CylinderOf(v.head<kCylinderParameters>()), BoxOf(v.tail<kBoxParameters>())};
}

PatternSearchResult Climb(const BeamLikelihood& likelihood, const TableFrame& base_from_table,
                          Kind kind, const Eigen::VectorXd& start) {
  PatternSearchOptions options;
  options.rounds = 3;
  if (kind != Kind::kBox) AppendCylinderSteps(options.steps, start.size(), 0);
  if (kind != Kind::kCylinder) {
    const Eigen::Index at = start.size() - kBoxParameters;
    AppendBoxSteps(options.steps, start.size(), at, start[at + 3]);
  }
  const auto score = [&](const Eigen::VectorXd& values) {
    const std::vector<SolidPart> parts = PartsOf(kind, values);
    if (!std::all_of(parts.begin(), parts.end(), Real))
      return -std::numeric_limits<double>::infinity();
    return LogLikelihoodOf(parts, base_from_table, likelihood);
  };
  return ClimbByPatternSearch(start, score, options);
}

AlternativeShape ShapeFrom(const char* name, Kind kind, const PatternSearchResult& found) {
  return {name, PartsOf(kind, found.values), static_cast<int>(found.values.size()), found.score};
}

Eigen::VectorXd Joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd joined(a.size() + b.size());
  joined << a, b;
  return joined;
}

/// The points that a solid in the table's frame does not explain.
Points Unexplained(const Points& points, const SolidPart& part, double tolerance_m) {
  Points rest;
  for (const Eigen::Vector3d& point : points)
    if (part.Distance(point) > tolerance_m) rest.push_back(point);
  return rest;
}

}  // namespace

std::vector<AlternativeShape> FitAlternativeShapes(const BeamLikelihood& likelihood,
                                                   const std::vector<Eigen::Vector3d>& foreground,
                                                   const TableFrame& base_from_table,
                                                   const Eigen::Vector2d& place) {
  constexpr std::size_t kMinPoints = 8;
  const auto table_from_base = base_from_table.Inverse();
  const Eigen::Vector2d viewer = (table_from_base * likelihood.rays().viewpoint).head<2>();
  Points points;
  for (const Eigen::Vector3d& point : foreground) {
    const Eigen::Vector3d at = table_from_base * point;
    if ((at.head<2>() - place).norm() < kReach_m) points.push_back(at);
  }
  std::vector<AlternativeShape> alternatives;
  if (points.size() < kMinPoints) return alternatives;

  const auto climb = [&](Kind kind, const Eigen::VectorXd& start) {
    return Climb(likelihood, base_from_table, kind, start);
  };
  Eigen::VectorXd narrow(kCylinderParameters);
  narrow << place.x(), place.y(), 0.027, 0.2;
  PatternSearchResult cylinder = climb(Kind::kCylinder, CylinderRound(points, viewer));
  if (const auto other = climb(Kind::kCylinder, narrow); other.score > cylinder.score)
    cylinder = other;
  const PatternSearchResult box = climb(Kind::kBox, BoxRound(points, viewer));
  alternatives.push_back(ShapeFrom("cylinder", Kind::kCylinder, cylinder));
  alternatives.push_back(ShapeFrom("box", Kind::kBox, box));

  // Both: a box round what either cylinder leaves over, above, below or beside it.
  const double tolerance = 2.0 * likelihood.rays().sigma_m + 0.005;
  PatternSearchResult both{{}, -std::numeric_limits<double>::infinity()};
  for (const Eigen::VectorXd& grip : {cylinder.values, narrow}) {
    const Points rest = Unexplained(points, CylinderOf(grip), tolerance);
    for (const double way : {1.0, -1.0}) {
      Points part = rest;
      const double middle = 0.5 * SpanAlong(points, Eigen::Vector3d::UnitZ()).high;
      std::erase_if(part, [&](const Eigen::Vector3d& p) { return way * (p.z() - middle) < 0.0; });
      if (part.size() < kMinPoints) continue;
      const auto tried = climb(Kind::kBoth, Joined(grip, BoxRound(part, viewer)));
      if (tried.score > both.score) both = tried;
    }
  }
  if (both.values.size() > 0)
    alternatives.push_back(ShapeFrom("box and cylinder", Kind::kBoth, both));
  std::stable_sort(alternatives.begin(), alternatives.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  return alternatives;
}

}  // namespace foresight
