#include "core/fitting/beam_model.h"

#include "core/fitting/wall.h"

namespace foresight {

double BackgroundDensity(const RangeRay& ray, std::span<const Plane> planes, double sigma_m) {
  if (planes.empty()) return BeamModel::kUniform;
  double density = 0.0;
  for (const Plane& plane : planes)
    density += NormalDensity(ray.range_m - RangeToPlane(ray, plane), sigma_m);
  return BeamModel::kPlaneFraction / static_cast<double>(planes.size()) * density +
         (1.0 - BeamModel::kPlaneFraction) * BeamModel::kUniform;
}

}  // namespace foresight
