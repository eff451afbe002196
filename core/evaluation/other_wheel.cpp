#include "core/evaluation/other_wheel.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "core/base/quantile.h"
#include "core/evaluation/other_world.h"
#include "core/geometry/angles.h"
#include "core/simulation/ray_caster.h"

namespace foresight {
namespace {

constexpr int kDirections = 360;

using Section = OtherWheel::Section;
using Outline = std::vector<Eigen::Vector2d>;

/// Convex, counter-clockwise, within size.x by size.y about the origin.
Outline SectionOf(Section kind, const Eigen::Vector2d& size) {
  Outline outline;
  const Eigen::Vector2d half = 0.5 * size;
  if (kind == Section::kFlatBar || kind == Section::kUprightBar) {
    // Edges are broken by a fifth of the thinner side.
    const double cut = 0.2 * std::min(half.x(), half.y());
    return {{half.x() - cut, -half.y()},  {half.x(), -half.y() + cut}, {half.x(), half.y() - cut},
            {half.x() - cut, half.y()},   {-half.x() + cut, half.y()}, {-half.x(), half.y() - cut},
            {-half.x(), -half.y() + cut}, {-half.x() + cut, -half.y()}};
  }
  constexpr int kCorners = 20;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    Eigen::Vector2d corner(half.x() * std::cos(angle), half.y() * std::sin(angle));
    // Flat below, and its middle stays at the origin.
    if (kind == Section::kHalfRound)
      corner.y() = std::max(corner.y(), -0.25 * half.y()) - 0.375 * half.y();
    outline.push_back(corner);
  }
  return outline;
}

Section RandomSection(Random& random) {
  constexpr Section kAll[] = {Section::kRound, Section::kFlatBar, Section::kUprightBar,
                              Section::kHalfRound};
  return kAll[random.Index(4)];
}

/// Sizes that go with a section; `size` is that of a round one.
Eigen::Vector2d SizeOf(Section kind, double size, Random& random) {
  const double ratio = random.Uniform(1.5, 4.0);
  switch (kind) {
    case Section::kFlatBar:
      return {size * std::sqrt(ratio), size / std::sqrt(ratio)};
    case Section::kUprightBar:
      return {size / std::sqrt(ratio), size * std::sqrt(ratio)};
    case Section::kRound:
    case Section::kHalfRound:
      break;
  }
  return {size, size * random.Uniform(0.85, 1.15)};
}

void Append(const Shape& shape, Shape& whole, double z = 0.0) {
  const int first = static_cast<int>(whole.vertices.size());
  for (const Eigen::Vector3f& vertex : shape.vertices)
    whole.vertices.push_back(vertex + Eigen::Vector3f(0.0f, 0.0f, static_cast<float>(z)));
  for (const Eigen::Vector3i& triangle : shape.triangles)
    whole.triangles.push_back(triangle + Eigen::Vector3i::Constant(first));
}

Eigen::Vector3d OnCircle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Along a circle, with its waves and its gap.
Shape RimOf(const OtherWheel& wheel) {
  constexpr int kSteps = 160;
  std::vector<Eigen::Vector3d> path;
  const bool whole = wheel.rim_arc_rad >= 2.0 * std::numbers::pi - 1e-9;
  // A whole rim runs a step beyond its beginning: its caps lie inside of it.
  for (int i = 0; i <= kSteps + (whole ? 1 : 0); ++i) {
    const double angle = wheel.rim_begin_rad + wheel.rim_arc_rad * i / kSteps;
    path.push_back(
        OnCircle(wheel.radius_m + wheel.waves_m * std::cos(wheel.waves * angle), angle, 0.0));
  }
  return SweptShape(SectionOf(wheel.rim, wheel.rim_m), path, Eigen::Vector3d::UnitZ());
}

Shape SpokeOf(const OtherWheel& wheel, double angle) {
  constexpr int kSteps = 12;
  std::vector<Eigen::Vector3d> path;
  std::vector<double> scales;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    path.push_back(OnCircle(t * wheel.radius_m, angle,
                            -(1.0 - t) * wheel.dish_m + 4.0 * wheel.spoke_bow_m * t * (1.0 - t)));
    scales.push_back(1.0 + t * (wheel.spoke_taper - 1.0));
  }
  return SweptShape(SectionOf(wheel.spoke, wheel.spoke_m), path, Eigen::Vector3d::UnitZ(), scales);
}

std::vector<double> Evenly(int count, double first) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(first + 2.0 * std::numbers::pi * i / count);
  return angles;
}

/// What is seen along the axis: hits by direction and radius.
class AxialView {
 public:
  static constexpr int kRadii = 90;

  explicit AxialView(const Shape& shape) {
    SceneMesh mesh;
    mesh.vertices = shape.vertices;
    mesh.triangles = shape.triangles;
    auto scene = std::make_shared<Scene>();
    scene->meshes.push_back(std::move(mesh));
    for (const Eigen::Vector3f& vertex : shape.vertices)
      reach_m_ = std::max(reach_m_, static_cast<double>(vertex.head<2>().norm()));
    const RayCaster caster(scene);
    std::vector<SceneRay> rays;
    for (int r = 0; r < kRadii; ++r)
      for (int a = 0; a < kDirections; ++a)
        rays.push_back({OnCircle(RadiusOf(r), (a + 0.5) * 2.0 * std::numbers::pi / kDirections, 2.0)
                            .cast<float>(),
                        -Eigen::Vector3f::UnitZ()});
    std::vector<SceneHit> hits(rays.size());
    caster.Cast(rays, hits);
    for (const SceneHit& hit : hits) filled_.push_back(hit.mesh >= 0);
  }

  double RadiusOf(double r) const { return reach_m_ * (r + 0.5) / kRadii; }
  bool Filled(int r, int a) const {
    return filled_[static_cast<std::size_t>(r * kDirections + (a + kDirections) % kDirections)];
  }
  double Cover(int r) const {
    int count = 0;
    for (int a = 0; a < kDirections; ++a) count += Filled(r, a) ? 1 : 0;
    return static_cast<double>(count) / kDirections;
  }

 private:
  double reach_m_ = 0.0;
  std::vector<bool> filled_;
};

constexpr double kClosed = 0.97;

/// The outermost filled band: where it begins and ends on average over the directions. A grip's
/// waves move it, spokes reach inwards from it.
struct Band {
  double inner = 0.0;
  double outer = -1.0;  ///< < 0 = there is none
  bool closed = false;  ///< 97 % of the directions have it about as far out
};

Band OutermostBand(const AxialView& view) {
  constexpr double kMostWaves = 0.15;
  std::vector<int> outer, width;
  for (int a = 0; a < kDirections; ++a) {
    int last = AxialView::kRadii - 1;
    while (last >= 0 && !view.Filled(last, a)) --last;
    if (last < 0) continue;
    int first = last;
    while (first > 0 && view.Filled(first - 1, a)) --first;
    outer.push_back(last);
    width.push_back(last - first);
  }
  if (outer.empty()) return {};
  const double usual = UpperMedian(outer);
  std::erase_if(outer, [&](int r) { return std::abs(r - usual) > kMostWaves * usual; });
  Band band;
  band.closed = static_cast<double>(outer.size()) >= kClosed * kDirections;
  band.outer = std::accumulate(outer.begin(), outer.end(), 0.0) / static_cast<double>(outer.size());
  band.inner = std::max(0.0, band.outer - UpperMedian(width));
  return band;
}

/// Middles of the filled runs of directions at a radius.
std::vector<double> RunsAt(const AxialView& view, int r) {
  std::vector<double> middles;
  int start = -1;
  for (int a = 0; a < kDirections; ++a)
    if (!view.Filled(r, a)) start = start < 0 ? a : start;
  if (start < 0) return middles;
  for (int k = 0; k < kDirections;) {
    if (!view.Filled(r, start + k)) {
      ++k;
      continue;
    }
    const int begin = k;
    while (k < kDirections && view.Filled(r, start + k)) ++k;
    middles.push_back(
        std::remainder((start + 0.5 * (begin + k)) * 2.0 * std::numbers::pi / kDirections,
                       2.0 * std::numbers::pi));
  }
  return middles;
}

}  // namespace

OtherWheel DrawWheel(Random& random) {
  OtherWheel wheel;
  wheel.radius_m = random.Uniform(0.05, 0.23);
  const double tube = std::clamp(wheel.radius_m * random.Uniform(0.08, 0.22), 0.010, 0.040);
  wheel.rim = RandomSection(random);
  wheel.rim_m = SizeOf(wheel.rim, tube, random);
  wheel.rim_m.x() = std::min(wheel.rim_m.x(), 0.45 * wheel.radius_m);
  if (random.Chance(0.25)) {
    wheel.waves = 6 + random.Index(10);
    wheel.waves_m = random.Uniform(0.02, 0.05) * wheel.radius_m;
  }
  wheel.spokes_rad =
      Evenly(2 + random.Index(5), random.Uniform(-std::numbers::pi, std::numbers::pi));
  wheel.spoke = RandomSection(random);
  wheel.spoke_m = SizeOf(wheel.spoke, tube * random.Uniform(0.5, 1.1), random);
  wheel.spoke_taper = random.Uniform(0.6, 1.2);
  wheel.spoke_bow_m = random.Chance(0.3) ? random.Uniform(-0.15, 0.15) * wheel.radius_m : 0.0;
  wheel.dish_m = random.Uniform(-0.1, 0.45) * wheel.radius_m;
  wheel.hub_radius_m = std::max(0.012, random.Uniform(0.12, 0.32) * wheel.radius_m);
  wheel.hub_length_m = random.Uniform(0.012, 0.06);
  wheel.knob_m = random.Chance(0.15) ? random.Uniform(0.03, 0.08) : 0.0;
  wheel.name = "wheel";
  return wheel;
}

OtherWheel DrawRoundThing(Random& random) {
  OtherWheel thing = DrawWheel(random);
  thing.knob_m = 0.0;
  const double first = random.Uniform(-std::numbers::pi, std::numbers::pi);
  switch (random.Index(7)) {
    case 0:
      thing.name = "broken wheel";
      thing.rim_begin_rad = first;
      thing.rim_arc_rad = random.Uniform(0.45, 0.85) * 2.0 * std::numbers::pi;
      break;
    case 1:
      thing.name = "fan's guard";
      thing.spokes_rad = Evenly(7 + random.Index(4), first);
      thing.rim_m = thing.spoke_m = {0.005, 0.005};
      for (double radius = 0.02; radius < thing.radius_m - 0.01; radius += 0.015)
        thing.rings_m.push_back(radius);
      break;
    case 2:
      thing.name = "steering wheel";
      thing.spokes_rad = {first, first + random.Uniform(1.2, 1.7), first + std::numbers::pi};
      break;
    case 3:
      thing.name = "pulley";
      thing.spokes_rad.clear();
      thing.web_m = random.Uniform(0.006, 0.02);
      break;
    case 4:
      thing.name = "hoop";
      thing.spokes_rad.clear();
      thing.hub_radius_m = 0.0;
      break;
    case 5:
      thing.name = "cross without a rim";
      thing.rim_arc_rad = 0.02;
      break;
    default:
      thing.name = "one spoke is missing";
      thing.spokes_rad = Evenly(4 + random.Index(2), first);
      thing.spokes_rad.pop_back();
      break;
  }
  return thing;
}

Shape ShapeOf(const OtherWheel& wheel) {
  Shape shape = RimOf(wheel);
  for (const double angle : wheel.spokes_rad) Append(SpokeOf(wheel, angle), shape);
  for (const double radius : wheel.rings_m) Append(TorusShape(radius, 0.0025), shape);
  if (wheel.hub_radius_m > 0.0)
    Append(CylinderShape(wheel.hub_radius_m, wheel.hub_length_m), shape, -wheel.dish_m);
  if (wheel.web_m > 0.0) Append(DishShape(wheel.radius_m, wheel.dish_m, wheel.web_m), shape);
  if (wheel.knob_m > 0.0) {
    const Eigen::Vector3d root = OnCircle(wheel.radius_m, wheel.rim_begin_rad + 0.7, 0.0);
    const std::vector<Eigen::Vector3d> path = {root,
                                               root + wheel.knob_m * Eigen::Vector3d::UnitZ()};
    Append(SweptShape(SectionOf(Section::kRound, {0.024, 0.024}), path, Eigen::Vector3d::UnitX()),
           shape);
  }
  return shape;
}

bool WheelMeasures::IsHandwheel() const {
  return closed_rim && hub && radius_m >= 0.045 && radius_m <= 0.240 && spokes >= 2 &&
         spokes <= 6 && unevenness_rad <= RadiansFromDegrees(8.0) && open >= 0.4;
}

WheelMeasures MeasureWheel(const Shape& shape) {
  const AxialView view(shape);
  const Band rim = OutermostBand(view);
  WheelMeasures measures;
  if (rim.outer < 0.0) return measures;
  const int inner = static_cast<int>(rim.inner);
  measures.closed_rim = rim.closed && inner > 0;
  measures.radius_m = 0.5 * (view.RadiusOf(rim.inner) + view.RadiusOf(rim.outer));
  measures.hub = view.Cover(0) >= kClosed;
  // Halfway out is beyond most hubs; the count of spokes is the one that most radii agree on.
  std::vector<std::pair<int, int>> counts;  // of runs, and the radius
  double open = 0.0;
  const int first = inner / 2, last = std::max(first + 1, inner * 4 / 5);
  for (int r = first; r < last; ++r) {
    counts.emplace_back(static_cast<int>(RunsAt(view, r).size()), r);
    open += (1.0 - view.Cover(r)) / (last - first);
  }
  measures.open = open;
  std::sort(counts.begin(), counts.end());
  const auto [runs, radius] = counts[counts.size() / 2];
  measures.spokes = runs;
  const std::vector<double> middles = RunsAt(view, radius);
  if (middles.empty()) return measures;
  measures.first_spoke_rad = middles.front();
  const double sector = 2.0 * std::numbers::pi / static_cast<double>(middles.size());
  for (const double middle : middles)
    measures.unevenness_rad = std::max(measures.unevenness_rad,
                                       std::abs(std::remainder(middle - middles.front(), sector)));
  return measures;
}

}  // namespace foresight
