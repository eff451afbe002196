#include "core/fitting/solids/solid_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fitting/solids/closest_on_ray.h"

namespace foresight {
namespace {

using Shape = SolidPart::Shape;
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kUnmeasuredDepth_m = -1.0;
constexpr double kLeastDepth_m = 1e-9;
// Parts that a ray enters one after another within this are one body, without an edge between them.
constexpr double kSameSurface_m = 0.02;

using LocalRay = RayBesideSolid;

/// Range at which a ray enters a box around the origin; infinite when it misses.
double EnterBox(const LocalRay& ray, const Eigen::Vector3d& half) {
  double enter = -kNever, leave = kNever;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(ray.direction[i]) < 1e-12) {
      if (std::abs(ray.origin[i]) > half[i]) return kNever;
      continue;
    }
    const double a = (-half[i] - ray.origin[i]) / ray.direction[i];
    const double b = (half[i] - ray.origin[i]) / ray.direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : kNever;
}

double EnterCylinder(const LocalRay& ray, double radius, double half_length) {
  const double a = ray.direction.head<2>().squaredNorm();
  double enter = -kNever, leave = kNever;
  const double across2 = ray.origin.head<2>().squaredNorm() - radius * radius;
  if (a > 1e-12) {
    const double b = ray.origin.head<2>().dot(ray.direction.head<2>());
    const double root2 = b * b - a * across2;
    if (root2 <= 0.0) return kNever;
    const double root = std::sqrt(root2);
    enter = (-b - root) / a;
    leave = (-b + root) / a;
  } else if (across2 > 0.0) {
    return kNever;
  }
  if (std::abs(ray.direction.z()) > 1e-12) {
    const double c = (-half_length - ray.origin.z()) / ray.direction.z();
    const double d = (half_length - ray.origin.z()) / ray.direction.z();
    enter = std::max(enter, std::min(c, d));
    leave = std::min(leave, std::max(c, d));
  } else if (std::abs(ray.origin.z()) > half_length) {
    return kNever;
  }
  return enter < leave ? enter : kNever;
}

double EnterSphere(const LocalRay& ray, double z, double radius) {
  const Eigen::Vector3d from = ray.origin - Eigen::Vector3d(0.0, 0.0, z);
  const double b = from.dot(ray.direction);
  const double root2 = b * b - from.squaredNorm() + radius * radius;
  return root2 > 0.0 ? -b - std::sqrt(root2) : kNever;
}

double Enter(Shape shape, const LocalRay& ray, const Eigen::Vector3d& half) {
  switch (shape) {
    case Shape::kBox:
      return EnterBox(ray, half);
    case Shape::kCylinder:
      return EnterCylinder(ray, half.x(), half.z());
    case Shape::kCapsule:
      return std::min({EnterCylinder(ray, half.x(), half.z()), EnterSphere(ray, half.z(), half.x()),
                       EnterSphere(ray, -half.z(), half.x())});
  }
  return kNever;
}

template <class Part>
LocalRay InPart(const RangeRay& ray, const Part& part) {
  return {part.part_from_base * ray.origin + part.offset, part.part_from_base * ray.direction};
}

bool PassesNear(const RangeRay& ray, const Eigen::Vector3d& middle, double bound_m) {
  const Eigen::Vector3d to_middle = middle - ray.origin;
  const double along = to_middle.dot(ray.direction);
  return to_middle.squaredNorm() - along * along <= bound_m * bound_m;
}

}  // namespace

SolidTracer::SolidTracer(std::span<const SolidPart> parts,
                         const Rigid<frame::Base, frame::Object>& base_from_object) {
  parts_.reserve(parts.size());
  for (const SolidPart& part : parts) {
    const auto base_from_part = base_from_object * part.object_from_part;
    Part made;
    made.shape = part.shape;
    made.part_from_base = base_from_part.RotationMatrix().transpose();
    made.middle = base_from_part.translation();
    made.offset = -(made.part_from_base * made.middle);
    made.half = 0.5 * part.size_m;
    made.bound_m = part.shape == Shape::kBox        ? made.half.norm()
                   : part.shape == Shape::kCylinder ? std::hypot(made.half.x(), made.half.z())
                                                    : made.half.x() + made.half.z();
    parts_.push_back(made);
  }
  for (const Part& part : parts_) middle_ += part.middle / static_cast<double>(parts_.size());
  for (const Part& part : parts_)
    bound_m_ = std::max(bound_m_, (part.middle - middle_).norm() + part.bound_m);
}

SolidIntersection SolidTracer::Intersect(const RangeRay& ray, double reach_m) const {
  SolidIntersection best{kNever, kNever, -1};
  if (!PassesNear(ray, middle_, bound_m_ + reach_m)) return best;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (!PassesNear(ray, part.middle, part.bound_m)) continue;
    const double enter = Enter(part.shape, InPart(ray, part), part.half);
    if (enter < best.range_m) best = {kUnmeasuredDepth_m, enter, static_cast<int>(i)};
  }
  return best.part < 0 && reach_m > 0.0 ? Passed(ray, reach_m) : best;
}

SolidIntersection SolidTracer::Passed(const RangeRay& ray, double reach_m) const {
  SolidIntersection best{kNever, kNever, -1};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (!PassesNear(ray, part.middle, part.bound_m + reach_m)) continue;
    const LocalRay local = InPart(ray, part);
    // Most rays miss a solid that is larger all round.
    const Eigen::Vector3d larger = part.half + Eigen::Vector3d::Constant(reach_m);
    if (Enter(part.shape, local, larger) == kNever) continue;
    const ClosestApproach closest = ClosestBeside(part.shape, local, part.half);
    if (closest.distance_m <= reach_m && closest.distance_m < best.clearance_m)
      best = {std::max(closest.distance_m, 0.0), closest.range_m, static_cast<int>(i)};
  }
  return best;
}

SolidIntersection SolidTracer::IntersectWithDepth(const RangeRay& ray, double reach_m) const {
  SolidIntersection intersection = Intersect(ray, reach_m);
  if (!intersection.Hits()) return intersection;
  const auto depth_in = [&](const Part& part) {
    return DeepestInside(part.shape, InPart(ray, part), part.half);
  };
  const auto first = static_cast<std::size_t>(intersection.part);
  intersection.clearance_m = depth_in(parts_[first]);
  for (std::size_t i = 0; i < parts_.size() && intersection.clearance_m > -reach_m; ++i) {
    const Part& part = parts_[i];
    if (i == first || !PassesNear(ray, part.middle, part.bound_m)) continue;
    const double enter = Enter(part.shape, InPart(ray, part), part.half);
    if (enter - intersection.range_m < kSameSurface_m)
      intersection.clearance_m = std::min(intersection.clearance_m, depth_in(part));
  }
  intersection.clearance_m =
      std::clamp(intersection.clearance_m, -std::max(reach_m, kLeastDepth_m), -kLeastDepth_m);
  return intersection;
}

PlacedSolids SolidTracer::Placed() const {
  PlacedSolids placed;
  placed.bound_m = bound_m_;
  Eigen::Vector3d::Map(placed.middle) = middle_;
  for (const Part& part : parts_) {
    PlacedSolid& solid = placed.parts.emplace_back();
    solid.shape = part.shape == Shape::kBox        ? PlacedSolid::Shape::kBox
                  : part.shape == Shape::kCylinder ? PlacedSolid::Shape::kCylinder
                                                   : PlacedSolid::Shape::kCapsule;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(solid.part_from_base) = part.part_from_base;
    Eigen::Vector3d::Map(solid.offset) = part.offset;
    Eigen::Vector3d::Map(solid.middle) = part.middle;
    Eigen::Vector3d::Map(solid.half) = part.half;
    solid.bound_m = part.bound_m;
  }
  return placed;
}

}  // namespace foresight
