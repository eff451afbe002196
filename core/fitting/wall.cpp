#include "core/fitting/wall.h"

#include <algorithm>

namespace foresight {
namespace {

constexpr double kMinWallFraction = 0.15;    // of the points that are looked at
constexpr double kMaxBehindFraction = 0.20;  // more behind a plane than this: it is no background
constexpr int kMaxPlanes = 3;

Plane Facing(Plane plane, const Eigen::Vector3d& viewpoint) {
  return plane.Distance(viewpoint) >= 0.0 ? plane : Plane{-plane.normal, -plane.offset};
}

}  // namespace

double RangeToPlane(const RangeRay& ray, const Plane& plane) {
  const double closing = -plane.normal.dot(ray.direction);
  return closing > 1e-3 ? plane.Distance(ray.origin) / closing : 1e9;
}

WallSplit SplitWall(const RaySet& rays, Random& random) {
  std::vector<Eigen::Vector3d> points;
  for (const RangeRay& ray : rays.rays) points.push_back(ray.Point());
  // A rim stands at least this far off its wall; nearer points are the wall's noise.
  const double clearance = std::max(0.030, 2.5 * rays.sigma_m);

  WallSplit split;
  std::vector<Eigen::Vector3d> candidates = points;
  for (int i = 0; i < kMaxPlanes && !split.wall; ++i) {
    PlaneSearchOptions options;
    options.inlier_distance_m = 2.0 * rays.sigma_m;
    options.min_inliers =
        std::max(20, static_cast<int>(kMinWallFraction * static_cast<double>(candidates.size())));
    const auto plane = FindDominantPlane(candidates, options, random);
    if (!plane) break;
    const Plane facing = Facing(*plane, rays.viewpoint);
    std::vector<Eigen::Vector3d> behind;
    for (const Eigen::Vector3d& point : candidates)
      if (facing.Distance(point) < -clearance) behind.push_back(point);
    if (static_cast<double>(behind.size()) >
        kMaxBehindFraction * static_cast<double>(candidates.size()))
      candidates = std::move(behind);
    else
      split.wall = facing;
  }
  for (const Eigen::Vector3d& point : points)
    if (!split.wall || split.wall->Distance(point) > clearance) split.foreground.push_back(point);
  return split;
}

}  // namespace foresight
