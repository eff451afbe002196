#include "core/fitting/drill/region_planes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace foresight {
namespace {

constexpr int kPlaneTrials = 300;

bool EndsOn(const RangeRay& ray, const Plane& plane, double sigma_m) {
  return std::abs(plane.Distance(ray.Point())) < OnPlaneTolerance(sigma_m, plane, ray);
}

}  // namespace

double OnPlaneTolerance(double sigma_m, const Plane& plane, const RangeRay& ray) {
  return 2.0 * sigma_m * std::abs(plane.normal.dot(ray.direction)) + kUnevenSurface_m;
}

std::optional<Plane> BestPlane(const Beams& beams, double sigma_m,
                               const std::function<double(const Plane&)>& weight, Random& random) {
  std::optional<Plane> best;
  double most = 0.0;
  const int count = static_cast<int>(std::ssize(beams));
  if (count < 3) return best;
  const auto drawn = [&] { return beams[static_cast<std::size_t>(random.Index(count))].Point(); };
  for (int trial = 0; trial < kPlaneTrials; ++trial) {
    const Eigen::Vector3d a = drawn(), b = drawn(), c = drawn();
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    if (cross.norm() < 1e-6) continue;
    const Plane plane{cross.normalized(), cross.normalized().dot(a)};
    const double counted = weight(plane);
    if (!(counted > 0.0)) continue;
    const double inliers = counted * static_cast<double>(std::count_if(
                                         beams.begin(), beams.end(), [&](const RangeRay& ray) {
                                           return EndsOn(ray, plane, sigma_m);
                                         }));
    if (inliers <= most) continue;
    most = inliers;
    best = plane;
  }
  return best;
}

Beams EndingOn(const Beams& beams, const Plane& plane, double sigma_m) {
  Beams on;
  std::copy_if(beams.begin(), beams.end(), std::back_inserter(on),
               [&](const RangeRay& ray) { return EndsOn(ray, plane, sigma_m); });
  return on;
}

}  // namespace foresight
