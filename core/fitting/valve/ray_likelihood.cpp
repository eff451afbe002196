#include "core/fitting/valve/ray_likelihood.h"

#include <cmath>

#include "core/fitting/valve/valve_tracer.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr double kUniform = 1.0 / 3.0;       // per metre: a return from anywhere within 3 m
constexpr double kHit = 0.93;                // a ray that meets the template returns from it
constexpr double kGrazing = 0.5;             // ... that just misses it
constexpr double kGoodReturn = 0.9;          // ... and has no other reason to be wrong
constexpr double kWallShare = 0.7;           // of the rays that miss
constexpr double kTemplateError_m = 0.0045;  // no real wheel is a torus with capsules
constexpr double kEdgeError_m = 0.00275;

double NormalDensity(double error, double sigma) {
  const double ratio = error / sigma;
  return ratio * ratio > 60.0 ? 0.0 : 0.3989422804014327 / sigma * std::exp(-0.5 * ratio * ratio);
}

}  // namespace

RayLikelihood::RayLikelihood(const RaySet& rays, const std::optional<Plane>& wall) : rays_(rays) {
  noise_.reserve(rays.rays.size());
  const double sigma = std::hypot(rays.sigma_m, kTemplateError_m);
  for (const RangeRay& ray : rays.rays) {
    RayNoise noise;
    noise.sigma_m = sigma;
    noise.width_m = 0.5 * rays.footprint_rad * ray.range_m + kEdgeError_m;
    noise.background = kUniform;
    if (wall)
      noise.background = kWallShare * NormalDensity(ray.range_m - RangeToPlane(ray, *wall), sigma) +
                         (1.0 - kWallShare) * kUniform;
    noise.log_background = std::log(noise.background);
    noise_.push_back(noise);
  }
}

double RayLikelihood::operator()(const ValveCandidate& valve, ValveParts parts) const {
  const ValveTracer tracer(valve, parts);
  double sum = 0.0;
  for (std::size_t i = 0; i < noise_.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    const RayNoise& noise = noise_[i];
    const double reach = 4.0 * noise.width_m;
    if (!tracer.Near(ray, reach)) {
      sum += noise.log_background;
      continue;
    }
    const ValveMeeting meeting = tracer.Meet(ray);
    const double clearance = meeting.Clearance();
    if (clearance > reach) {
      sum += noise.log_background;
      continue;
    }
    const double ratio = clearance / noise.width_m;
    const double hit = clearance <= 0.0 ? kHit : kGrazing * std::exp(-0.5 * ratio * ratio);
    const double on_valve =
        kGoodReturn * NormalDensity(ray.range_m - meeting.Range(), noise.sigma_m) +
        (1.0 - kGoodReturn) * kUniform;
    sum += std::log(hit * on_valve + (1.0 - hit) * noise.background);
  }
  return rays_.samples_per_ray * sum + LogPrior(valve.model);
}

double RayLikelihood::Nothing() const {
  double sum = 0.0;
  for (const RayNoise& noise : noise_) sum += noise.log_background;
  return rays_.samples_per_ray * sum;
}

}  // namespace foresight
