#include "core/fitting/cylinder/background_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr int kMostPlanes = 3;
constexpr double kLeastFraction = 0.10;  // of all rays
constexpr int kLeastPoints = 20;
constexpr double kOnSurface_sigmas = 2.5;

Plane Facing(const Plane& plane, const Eigen::Vector3d& viewpoint) {
  return plane.Distance(viewpoint) >= 0.0 ? plane : Plane{-plane.normal, -plane.offset};
}

bool OnCylinder(const CylinderState& cylinder, const Eigen::Vector3d& point, double tolerance_m) {
  return std::abs(cylinder.FromAxis(point).norm() - cylinder.radius_m) < tolerance_m &&
         std::abs((point - cylinder.middle).dot(cylinder.axis)) <
             0.5 * cylinder.length_m + tolerance_m;
}

}  // namespace

std::vector<Plane> FindFlatSurfaces(const RaySet& rays, Random& random) {
  std::vector<Eigen::Vector3d> points;
  for (const RangeRay& ray : rays.rays) points.push_back(ray.Point());
  PlaneSearchOptions options;
  options.inlier_distance_m = kOnSurface_sigmas * rays.sigma_m;
  options.min_inliers =
      std::max(kLeastPoints, static_cast<int>(kLeastFraction * static_cast<double>(points.size())));
  std::vector<Plane> planes;
  while (static_cast<int>(planes.size()) < kMostPlanes) {
    const auto plane = FindDominantPlane(points, options, random);
    if (!plane) break;
    planes.push_back(Facing(*plane, rays.viewpoint));
    std::erase_if(points, [&](const Eigen::Vector3d& point) {
      return std::abs(plane->Distance(point)) < 1.5 * options.inlier_distance_m;
    });
  }
  return planes;
}

std::vector<Plane> PlanesBeside(const CylinderState& cylinder, const std::vector<Plane>& planes,
                                const RaySet& rays) {
  const double tolerance_m = kOnSurface_sigmas * rays.sigma_m;
  std::vector<Plane> beside;
  for (const Plane& plane : planes) {
    int on_plane = 0, on_both = 0;
    for (const RangeRay& ray : rays.rays) {
      const Eigen::Vector3d point = ray.Point();
      if (std::abs(plane.Distance(point)) > tolerance_m) continue;
      ++on_plane;
      on_both += OnCylinder(cylinder, point, tolerance_m) ? 1 : 0;
    }
    if (2 * on_both < on_plane) beside.push_back(plane);
  }
  // Footprints mix with the first: what lies behind it comes before a floor or a wall beside it.
  const Eigen::Vector3d to_middle = cylinder.middle - rays.viewpoint;
  const RangeRay ray{rays.viewpoint, to_middle.normalized(), to_middle.norm()};
  const auto range_behind_m = [&](const Plane& plane) {
    const double range_m = RangeToPlane(ray, plane);
    return range_m > ray.range_m ? range_m : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(beside.begin(), beside.end(), [&](const Plane& a, const Plane& b) {
    return range_behind_m(a) < range_behind_m(b);
  });
  return beside;
}

}  // namespace foresight
