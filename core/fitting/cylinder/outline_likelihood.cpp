#include "core/fitting/cylinder/outline_likelihood.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/fitting/beam_model.h"
#include "core/fitting/drill/solid_tracer.h"

namespace foresight {
namespace {

constexpr double kShapeError_m = 0.005;  // no real pole is smooth and straight
constexpr double kEdgeError_m = 0.003;
constexpr double kReachWidths = 3.0;

}  // namespace

OutlineLikelihood::OutlineLikelihood(RaySet rays, std::span<const Plane> planes)
    : rays_(std::move(rays)), sigma_m_(std::hypot(rays_.sigma_m, kShapeError_m)) {
  noise_.reserve(rays_.rays.size());
  for (const RangeRay& ray : rays_.rays) {
    const double background = BackgroundDensity(ray, planes, sigma_m_);
    noise_.push_back({0.5 * rays_.footprint_rad * ray.range_m, background, std::log(background)});
  }
}

double OutlineLikelihood::operator()(const SolidPart& solid_in_base) const {
  const SolidTracer tracer({&solid_in_base, 1}, {});
  double sum = 0.0;
  for (std::size_t i = 0; i < noise_.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    const RayNoise& noise = noise_[i];
    const double shift_m = 0.5 * noise.footprint_m,
                 width_m = 0.5 * noise.footprint_m + kEdgeError_m;
    const SolidIntersection intersection =
        tracer.IntersectWithDepth(ray, shift_m + kReachWidths * width_m);
    if (intersection.part < 0) {
      sum += noise.log_background;
      continue;
    }
    const double beyond = (intersection.clearance_m - shift_m) / width_m;
    const double hit = 0.5 * BeamModel::kHit * std::erfc(beyond / std::numbers::sqrt2);
    const double on_solid =
        BeamModel::kGoodReturn * NormalDensity(ray.range_m - intersection.range_m, sigma_m_) +
        (1.0 - BeamModel::kGoodReturn) * BeamModel::kUniform;
    sum += std::log(hit * on_solid + (1.0 - hit) * noise.background);
  }
  return rays_.samples_per_ray * sum;
}

}  // namespace foresight
