#include "core/fitting/solids/closest_on_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/objects/solid_distance.h"

namespace foresight {
namespace {

constexpr double kInfinite_m = std::numeric_limits<double>::infinity();
constexpr double kParallel = 1e-12;     // of a direction's squared part
constexpr double kNewtonStep_m = 1e-5;  // where it has settled
constexpr int kNewtonSteps = 12;

/// How far a coordinate lies beyond a slab of this half thickness, with its sign.
double Beyond(double coordinate, double half) {
  return coordinate - std::clamp(coordinate, -half, half);
}

Eigen::Vector3d At(const RayBesideSolid& ray, double range_m) {
  return ray.origin + range_m * ray.direction;
}

/// The derivative of the squared distance to a box rises along the line, piecewise linearly between
/// the faces' planes.
ClosestApproach BesideBox(const RayBesideSolid& ray, const Eigen::Vector3d& half) {
  const auto slope = [&](double range_m) {
    const Eigen::Vector3d point = At(ray, range_m);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += ray.direction[i] * Beyond(point[i], half[i]);
    return sum;
  };
  double low = -kInfinite_m, high = kInfinite_m, at_low = 0.0, at_high = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (ray.direction[i] * ray.direction[i] < kParallel) continue;
    for (const double side : {-half[i], half[i]}) {
      const double range_m = (side - ray.origin[i]) / ray.direction[i];
      if (range_m <= low || range_m >= high) continue;
      const double here = slope(range_m);
      if (here <= 0.0)
        low = range_m, at_low = here;
      else
        high = range_m, at_high = here;
    }
  }
  double range_m = std::isfinite(low) ? low : high;
  if (std::isfinite(low) && std::isfinite(high))
    range_m = low + (high - low) * (-at_low / (at_high - at_low));
  return {DistanceToSolid(SolidPart::Shape::kBox, At(ray, range_m), half), range_m};
}

/// Where the line is nearest to the z axis; beside the origin where it runs along the axis.
double NearestToAxis(const RayBesideSolid& ray) {
  const double across2 = ray.direction.head<2>().squaredNorm();
  if (across2 < kParallel) return -ray.origin.z() * ray.direction.z();
  return -ray.origin.head<2>().dot(ray.direction.head<2>()) / across2;
}

ClosestApproach BesideCapsule(const RayBesideSolid& ray, const Eigen::Vector3d& half) {
  double range_m = NearestToAxis(ray);
  const double z = At(ray, range_m).z();
  if (std::abs(z) > half.z()) {
    const Eigen::Vector3d end(0.0, 0.0, std::copysign(half.z(), z));
    range_m = (end - ray.origin).dot(ray.direction);
  }
  return {DistanceToSolid(SolidPart::Shape::kCapsule, At(ray, range_m), half), range_m};
}

ClosestApproach BesideCylinder(const RayBesideSolid& ray, const Eigen::Vector3d& half) {
  const double radius = half.x(), along = ray.direction.z();
  const double nearest_m = NearestToAxis(ray);
  const double z = At(ray, nearest_m).z();
  const auto at = [&](double range_m) {
    return ClosestApproach{DistanceToSolid(SolidPart::Shape::kCylinder, At(ray, range_m), half),
                           range_m};
  };
  if (std::abs(z) <= half.z() || along * along < kParallel) return at(nearest_m);
  // Beyond an end: between there and where the line comes beside the solid. Half the derivative of
  // the squared distance rises in between.
  const double beside_m = (std::copysign(half.z(), z) - ray.origin.z()) / along;
  double low = std::min(nearest_m, beside_m), high = std::max(nearest_m, beside_m);
  double range_m = 0.5 * (low + high);
  const Eigen::Vector2d direction = ray.direction.head<2>();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Eigen::Vector3d point = At(ray, range_m);
    double slope = along * Beyond(point.z(), half.z());
    double curvature = along * along;
    const double radial2 = point.head<2>().squaredNorm();
    if (radial2 > radius * radius) {
      const double inside = radius / std::sqrt(radial2);
      const double moving = point.head<2>().dot(direction);
      slope += moving * (1.0 - inside);
      curvature += direction.squaredNorm() * (1.0 - inside) + moving * moving * inside / radial2;
    }
    (slope > 0.0 ? high : low) = range_m;
    double next_m = range_m - slope / curvature;
    if (!(next_m > low && next_m < high)) next_m = 0.5 * (low + high);
    const double moved_m = std::abs(next_m - range_m);
    range_m = next_m;
    if (moved_m < kNewtonStep_m) break;
  }
  return at(range_m);
}

// Along the line every face's signed distance is a straight line; where the largest of them is
// least, one that falls crosses one that rises.
double DeepestInBox(const RayBesideSolid& ray, const Eigen::Vector3d& half) {
  const Eigen::Array3d steep = ray.direction.array().abs().max(kParallel);
  const Eigen::Array3d ahead =
      (ray.direction.array() < 0.0).select(-ray.origin.array(), ray.origin.array());
  const Eigen::Array3d falling = -ahead - half.array(), rising = ahead - half.array();
  double deepest_m = -kInfinite_m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      deepest_m = std::max(deepest_m,
                           (steep[j] * falling[i] + steep[i] * rising[j]) / (steep[i] + steep[j]));
  return deepest_m;
}

// Deepest in the mantle where the line is nearest to the axis, unless an end is nearer there: then
// where it is as far from both on the way to the middle.
double DeepestInCylinder(const RayBesideSolid& ray, const Eigen::Vector3d& half) {
  const Eigen::Vector3d nearest = At(ray, NearestToAxis(ray));
  const double radial2 = nearest.head<2>().squaredNorm();
  const double in_mantle_m = std::sqrt(radial2) - half.x();
  const double z = std::abs(nearest.z()), beyond_end_m = z - half.z();
  if (in_mantle_m >= beyond_end_m) return in_mantle_m;
  const double across2 = ray.direction.head<2>().squaredNorm(), down = std::abs(ray.direction.z());
  const double wide_m = half.x() + beyond_end_m, wide2 = wide_m * wide_m - radial2;
  const double way_m = wide2 / (wide_m * down + std::sqrt(across2 * wide2 + down * down * radial2));
  return std::max(beyond_end_m - down * way_m, -half.z());
}

}  // namespace

ClosestApproach ClosestBeside(SolidPart::Shape shape, const RayBesideSolid& ray,
                              const Eigen::Vector3d& half) {
  switch (shape) {
    case SolidPart::Shape::kBox:
      return BesideBox(ray, half);
    case SolidPart::Shape::kCylinder:
      return BesideCylinder(ray, half);
    case SolidPart::Shape::kCapsule:
      return BesideCapsule(ray, half);
  }
  return {kInfinite_m, kInfinite_m};
}

double DeepestInside(SolidPart::Shape shape, const RayBesideSolid& ray,
                     const Eigen::Vector3d& half) {
  switch (shape) {
    case SolidPart::Shape::kBox:
      return DeepestInBox(ray, half);
    case SolidPart::Shape::kCylinder:
      return DeepestInCylinder(ray, half);
    case SolidPart::Shape::kCapsule:
      return BesideCapsule(ray, half).distance_m;
  }
  return kInfinite_m;
}

}  // namespace foresight
