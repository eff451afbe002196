#include "core/fitting/ray_selection.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"

namespace foresight {
namespace {

bool Usable(const RangeRay& ray) {
  return ray.origin.allFinite() && ray.direction.allFinite() && std::isfinite(ray.range_m) &&
         ray.range_m > 0.0;
}

}  // namespace

RaySet Thinned(const RaySet& rays, int count, Random& random) {
  RaySet thinned = rays;
  thinned.rays = RandomSubset(rays.rays, count, random);
  const double fraction = static_cast<double>(thinned.rays.size()) /
                          static_cast<double>(std::max<std::size_t>(1, rays.rays.size()));
  thinned.samples_per_ray = std::min(1.0, rays.samples_per_ray / fraction);
  return thinned;
}

RaySet WithoutImage(RaySet rays) {
  rays.image = nullptr;
  return rays;
}

Eigen::Vector3d MedianPlace(std::span<const RangeRay> rays) {
  std::array<std::vector<double>, 3> places;
  for (const RangeRay& ray : rays) {
    const Eigen::Vector3d at = ray.Point();
    for (std::size_t axis = 0; axis < 3; ++axis)
      places[axis].push_back(at[static_cast<Eigen::Index>(axis)]);
  }
  Eigen::Vector3d middle;
  for (std::size_t axis = 0; axis < 3; ++axis)
    middle[static_cast<Eigen::Index>(axis)] = Quantile(std::move(places[axis]), 0.5);
  return middle;
}

Eigen::Vector3d PlaceInMiddle(const RaySet& rays) {
  constexpr double kMiddle = 0.3, kNearest = 0.5;  // of the rays
  Eigen::Vector3d sight = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : rays.rays) sight += ray.direction;
  std::vector<RangeRay> middle = rays.rays;
  const auto keep = [&](double fraction, const auto& before) {
    const auto count =
        static_cast<std::ptrdiff_t>(std::ceil(fraction * static_cast<double>(middle.size())));
    std::nth_element(middle.begin(), middle.begin() + (count - 1), middle.end(), before);
    middle.resize(static_cast<std::size_t>(count));
  };
  keep(kMiddle, [&](const RangeRay& a, const RangeRay& b) {
    return sight.dot(a.direction) > sight.dot(b.direction);
  });
  keep(kNearest, [](const RangeRay& a, const RangeRay& b) { return a.range_m < b.range_m; });
  return MedianPlace(middle);
}

const RaySet* SurroundingBeams(const RaySet& region) {
  return region.around ? &region.around->Measured() : nullptr;
}

std::shared_ptr<const RaySet> ThinnedBeams(const RaySet& rays, int count, int least,
                                           Random& random) {
  if (rays.beams == nullptr) return nullptr;
  const Result<RaySet> usable = UsableRays(*rays.beams, least, "it");
  if (!usable) return nullptr;
  return std::make_shared<const RaySet>(Thinned(*usable, count, random));
}

Status CheckRayNoise(const RaySet& rays) {
  if (!(rays.sigma_m > 0.0) || !(rays.footprint_rad >= 0.0) || !(rays.samples_per_ray > 0.0) ||
      !rays.viewpoint.allFinite())
    return Fail(ErrorCode::kInvalidInput,
                "rays of the region: sigma_m {}, footprint_rad {} or samples_per_ray {} is not "
                "usable",
                rays.sigma_m, rays.footprint_rad, rays.samples_per_ray);
  return {};
}

Result<RaySet> UsableRays(const RaySet& rays, int least, const char* object) {
  FORESIGHT_CHECK(CheckRayNoise(rays));
  RaySet usable = rays;
  std::erase_if(usable.rays, [](const RangeRay& ray) { return !Usable(ray); });
  if (std::ssize(usable.rays) < least)
    return Fail(
        ErrorCode::kTooFewPoints,
        "the region holds too few measurements: {}, {} needs {}: draw it larger, scan slower or "
        "move closer",
        usable.rays.size(), object, least);
  return usable;
}

}  // namespace foresight
