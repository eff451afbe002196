#include "core/fitting/valve/valve_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace foresight {
namespace {

// A ray along a tube would enter it infinitely early; real spokes are short.
constexpr double kMaxStretch = 3.0;

/// The ray's closest approach to a point of a middle line that runs along `tangent` there; a point
/// of a sphere or an end has none.
ValveIntersection Approach(ValvePart part, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction, const Eigen::Vector3d& point,
                           const Eigen::Vector3d& tangent, double radius) {
  ValveIntersection intersection;
  intersection.part = part;
  intersection.radius_m = intersection.depth_m = radius;
  intersection.middle_m = (point - origin).dot(direction);
  const Eigen::Vector3d offset = origin + intersection.middle_m * direction - point;
  intersection.offset_m = offset.norm();
  const Eigen::Vector3d across = tangent.cross(direction);
  const double sine = across.norm();
  if (sine > 1e-3) {
    intersection.across = (across.dot(offset) < 0.0 ? -1.0 : 1.0) / sine * across;
    intersection.stretch = std::min(1.0 / sine, kMaxStretch);
    return intersection;
  }
  if (intersection.offset_m > 1e-9) intersection.across = offset / intersection.offset_m;
  intersection.stretch = tangent.isZero() ? 1.0 : kMaxStretch;
  return intersection;
}

/// Turns the round section of an intersection into an ellipse with half axes `width` and `depth`
/// along these axes, unit vectors across the middle line and each other.
void FlattenSection(double width, double depth, const Eigen::Vector3d& width_axis,
                    const Eigen::Vector3d& depth_axis, const Eigen::Vector3d& direction,
                    ValveIntersection& intersection) {
  if (width == depth) return;
  // In the plane of the section, along the ray and across it.
  Eigen::Vector2d along(width_axis.dot(direction), depth_axis.dot(direction));
  const double length = along.norm();
  if (length < 1e-3) return;
  along /= length;
  const double sideways = depth_axis.dot(intersection.across) * along.x() -
                          width_axis.dot(intersection.across) * along.y();
  const double side = sideways < 0.0 ? -1.0 : 1.0;
  const double half2 =
      width * width * along.y() * along.y() + depth * depth * along.x() * along.x();
  intersection.radius_m = std::sqrt(half2);
  intersection.depth_m = width * depth / intersection.radius_m;
  intersection.lean = side * along.x() * along.y() * (depth * depth - width * width) / half2;
}

/// Where along a line (point, unit direction) it is closest to a ray.
double ClosestAlongLine(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                        const Eigen::Vector3d& point, const Eigen::Vector3d& along) {
  const double cosine = along.dot(direction);
  const Eigen::Vector3d from_ray = point - origin;
  const double sine2 = std::max(1.0 - cosine * cosine, 1e-6);
  return (cosine * from_ray.dot(direction) - from_ray.dot(along)) / sine2;
}

/// Of two parts the one that is intersected first, or missed by less, is kept.
void KeepFirstMet(const ValveIntersection& other, ValveIntersection& best) {
  const double gap_best = best.Clearance(), gap_other = other.Clearance();
  const bool both_met = gap_best < 0.0 && gap_other < 0.0;
  if (both_met ? other.Range() < best.Range() : gap_other < gap_best) best = other;
}

}  // namespace

double ValveIntersection::Range() const {
  const double middle = middle_m + stretch * lean * std::min(offset_m, radius_m);
  const double part2 = 1.0 - offset_m * offset_m / (radius_m * radius_m);
  return part2 > 0.0 ? middle - stretch * depth_m * std::sqrt(part2) : middle;
}

ValveTracer::ValveTracer(const ValveCandidate& valve, ValveParts parts)
    : object_from_base_(valve.base_from_object.RotationMatrix().transpose()),
      center_(valve.base_from_object.translation()),
      model_(valve.model),
      parts_(parts),
      hub_(0.0, 0.0, valve.model.IsLever() ? 0.0 : -valve.model.dish_m) {
  if (model_.IsLever()) {
    reach_m_ = model_.lever_length_m + model_.tube_radius_m;
    const double stem_m = ValveModel::kLeverStemPerHub * model_.hub_radius_m;
    lever_ = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), model_.lever_length_m,
              model_.tube_radius_m,    model_.tube_radius_m,     Eigen::Vector3d::UnitZ()};
    stem_ = {Eigen::Vector3d::Zero(),
             -Eigen::Vector3d::UnitZ(),
             ValveModel::kLeverStem_m,
             stem_m,
             stem_m,
             Eigen::Vector3d::UnitX()};
    return;
  }
  reach_m_ = model_.rim_radius_m + std::max(model_.tube_radius_m, model_.RimDepth()) +
             std::max(0.0, std::abs(model_.dish_m) + model_.hub_radius_m - model_.rim_radius_m);
  for (int i = 0; i < model_.spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / model_.spokes;
    const Eigen::Vector3d end(model_.rim_radius_m * std::cos(angle),
                              model_.rim_radius_m * std::sin(angle), 0.0);
    const double length = (end - hub_).norm();
    const Eigen::Vector3d direction = (end - hub_) / length;
    const Eigen::Vector3d sideways(-std::sin(angle), std::cos(angle), 0.0);
    spokes_[static_cast<std::size_t>(i)] = {hub_,
                                            direction,
                                            length,
                                            model_.spoke_radius_m,
                                            model_.SpokeDepth(),
                                            direction.cross(sideways)};
  }
}

bool ValveTracer::Near(const RangeRay& ray, double margin_m) const {
  const Eigen::Vector3d to_center = center_ - ray.origin;
  const double along = to_center.dot(ray.direction);
  const double reach = reach_m_ + margin_m;
  return to_center.squaredNorm() - along * along < reach * reach;
}

/// False for a ray that passes a point further away.
bool ValveTracer::StaysWithin(const LocalRay& ray, const Eigen::Vector3d& point, double reach_m) {
  const Eigen::Vector3d from_ray = point - ray.origin;
  const double middle_m = from_ray.dot(ray.direction);
  return from_ray.squaredNorm() - middle_m * middle_m <= reach_m * reach_m;
}

bool ValveTracer::PassesRim(const LocalRay& ray, double reach_m) const {
  const double closing = std::abs(ray.direction.z());
  if (closing <= 0.1) return true;
  const Eigen::Vector3d crossing = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
  // However the ray goes on from where it crosses the rim's plane, it comes no nearer than this.
  const double least_m = closing * std::abs(crossing.head<2>().norm() - model_.rim_radius_m);
  return least_m <= reach_m + std::max(model_.tube_radius_m, model_.RimDepth());
}

ValveIntersection ValveTracer::IntersectRim(const LocalRay& ray) const {
  const double radius = model_.rim_radius_m;
  // From where the ray crosses the rim's plane; along it there is no crossing, take the nearest
  // point to the centre.
  const bool crosses = std::abs(ray.direction.z()) > 0.1;
  const double start =
      crosses ? -ray.origin.z() / ray.direction.z() : -ray.origin.dot(ray.direction);
  Eigen::Vector3d point = ray.origin + start * ray.direction;
  Eigen::Vector3d on_rim;
  Eigen::Vector3d tangent;
  // The circle is nearly straight over the distance of one step: two steps leave micrometres.
  for (int step = 0; step < 3; ++step) {
    const double radial = std::max(point.head<2>().norm(), 1e-9);
    on_rim = {radius * point.x() / radial, radius * point.y() / radial, 0.0};
    tangent = {-on_rim.y() / radius, on_rim.x() / radius, 0.0};
    if (step < 2)
      point = on_rim + ClosestAlongLine(ray.origin, ray.direction, on_rim, tangent) * tangent;
  }
  ValveIntersection intersection =
      Approach(ValvePart::kRim, ray.origin, ray.direction, on_rim, tangent, model_.tube_radius_m);
  FlattenSection(model_.tube_radius_m, model_.RimDepth(), on_rim / radius, Eigen::Vector3d::UnitZ(),
                 ray.direction, intersection);
  intersection.on_rim = on_rim.head<2>();
  return intersection;
}

ValveIntersection ValveTracer::IntersectHub(const LocalRay& ray) const {
  return Approach(ValvePart::kHub, ray.origin, ray.direction, hub_, Eigen::Vector3d::Zero(),
                  model_.hub_radius_m);
}

double ValveTracer::AlongBar(const LocalRay& ray, const Bar& bar) {
  return std::clamp(ClosestAlongLine(ray.origin, ray.direction, bar.begin, bar.direction), 0.0,
                    bar.length_m);
}

ValveIntersection ValveTracer::IntersectBar(ValvePart part, const LocalRay& ray, const Bar& bar,
                                            double along) {
  const bool at_end = part == ValvePart::kLever && along == bar.length_m;
  const Eigen::Vector3d tangent = at_end ? Eigen::Vector3d::Zero() : bar.direction;
  ValveIntersection intersection = Approach(
      part, ray.origin, ray.direction, bar.begin + along * bar.direction, tangent, bar.radius_m);
  if (!at_end)
    FlattenSection(bar.radius_m, bar.depth_m, bar.direction.cross(bar.depth_axis), bar.depth_axis,
                   ray.direction, intersection);
  intersection.along_m = along;
  return intersection;
}

ValveIntersection ValveTracer::IntersectStem(const LocalRay& ray) const {
  ValveIntersection intersection = IntersectBar(ValvePart::kStem, ray, stem_, AlongBar(ray, stem_));
  const Eigen::Vector3d entry = ray.origin + intersection.Range() * ray.direction;
  // Seen from the front, a stem without end would be entered before its beginning.
  if ((entry - stem_.begin).dot(stem_.direction) < 0.0)
    intersection = Approach(ValvePart::kStem, ray.origin, ray.direction, stem_.begin,
                            Eigen::Vector3d::Zero(), stem_.radius_m);
  return intersection;
}

bool ValveTracer::IntersectDisc(const LocalRay& ray, ValveIntersection& intersection) const {
  if (std::abs(ray.direction.z()) < 0.1) return false;
  double range = -ray.origin.z() / ray.direction.z();
  double radial = 0.0;
  // The cone from hub to rim is flat: its height at the last crossing gives the next one.
  for (int step = 0; step < 4; ++step) {
    const Eigen::Vector3d point = ray.origin + range * ray.direction;
    radial = point.head<2>().norm();
    const double height = -model_.dish_m * std::max(0.0, 1.0 - radial / model_.rim_radius_m);
    range = (height - ray.origin.z()) / ray.direction.z();
  }
  if (radial >= model_.rim_radius_m) return false;
  intersection = ValveIntersection{};
  intersection.part = ValvePart::kDisc;
  intersection.middle_m = range;
  intersection.radius_m = intersection.depth_m = model_.spoke_radius_m;
  intersection.stretch = std::min(1.0 / std::abs(ray.direction.z()), kMaxStretch);
  return true;
}

ValveIntersection ValveTracer::IntersectWheel(const LocalRay& ray, double reach_m) const {
  ValveIntersection best;
  best.offset_m = std::numeric_limits<double>::infinity();
  if (PassesRim(ray, reach_m)) best = IntersectRim(ray);
  if (parts_ == ValveParts::kRim) return best;
  if (StaysWithin(ray, hub_, std::clamp(best.Clearance(), 0.0, reach_m) + model_.hub_radius_m))
    KeepFirstMet(IntersectHub(ray), best);
  for (int i = 0; i < model_.spokes; ++i) {
    const Bar& bar = spokes_[static_cast<std::size_t>(i)];
    const double along = AlongBar(ray, bar);
    // Most spokes are farther than what the ray passes already.
    const double near_m =
        std::clamp(best.Clearance(), 0.0, reach_m) + std::max(bar.radius_m, bar.depth_m);
    if (!StaysWithin(ray, bar.begin + along * bar.direction, near_m)) continue;
    ValveIntersection spoke = IntersectBar(ValvePart::kSpoke, ray, bar, along);
    spoke.spoke = i;
    KeepFirstMet(spoke, best);
  }
  if (ValveIntersection disc; model_.spokes == 0 && IntersectDisc(ray, disc))
    KeepFirstMet(disc, best);
  return best;
}

ValveIntersection ValveTracer::IntersectLever(const LocalRay& ray) const {
  ValveIntersection best = IntersectBar(ValvePart::kLever, ray, lever_, AlongBar(ray, lever_));
  KeepFirstMet(IntersectHub(ray), best);
  KeepFirstMet(IntersectStem(ray), best);
  return best;
}

ValveIntersection ValveTracer::Intersect(const RangeRay& ray, double reach_m) const {
  const LocalRay local{object_from_base_ * (ray.origin - center_),
                       object_from_base_ * ray.direction};
  ValveIntersection intersection =
      model_.IsLever() ? IntersectLever(local) : IntersectWheel(local, reach_m);
  intersection.across = object_from_base_.transpose() * intersection.across;
  return intersection;
}

}  // namespace foresight
