#include "core/fitting/region_place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace foresight {

double DistanceFromRegionCenter(const RaySet& region, const Eigen::Vector3d& point) {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : region.rays) direction += ray.direction;
  direction.normalize();
  const Eigen::Vector3d to_point = point - region.viewpoint;
  return (to_point - to_point.dot(direction) * direction).norm();
}

double DistanceFromRays(const RaySet& region, const Eigen::Vector3d& point) {
  double least2 = std::numeric_limits<double>::infinity();
  for (const RangeRay& ray : region.rays)
    least2 = std::min(least2, (point - ray.origin).cross(ray.direction).squaredNorm());
  return std::sqrt(least2);
}

}  // namespace foresight
