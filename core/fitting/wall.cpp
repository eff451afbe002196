#include "core/fitting/wall.h"

#include <algorithm>
#include <utility>

namespace foresight {
namespace {

constexpr double kMinWallFraction = 0.15;    // of the points that are looked at
constexpr double kMaxBehindFraction = 0.20;  // more behind a plane than this: it is no background
constexpr int kMaxPlanes = 3;
constexpr std::size_t kFewInBox = 25;  // too few to look for anything

Plane Facing(Plane plane, const Eigen::Vector3d& viewpoint) {
  return plane.Distance(viewpoint) >= 0.0 ? plane : Plane{-plane.normal, -plane.offset};
}

void SetForeground(const RaySet& rays, double clearance_m, WallSplit& split) {
  std::vector<Eigen::Vector3d> in_box;
  for (const RangeRay& ray : rays.rays) {
    const Eigen::Vector3d point = ray.Point();
    if (split.wall && split.wall->Distance(point) <= clearance_m) continue;
    split.foreground.push_back(point);
    if (rays.box && rays.box->Contains(point)) in_box.push_back(point);
  }
  // A box that misses most of its object tells less than what stands before the wall.
  if (in_box.size() >= kFewInBox) split.foreground = std::move(in_box);
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
  SetForeground(rays, clearance, split);
  return split;
}

WallSplit NoWall(const RaySet& rays) {
  WallSplit split;
  SetForeground(rays, 0.0, split);
  return split;
}

}  // namespace foresight
