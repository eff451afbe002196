#include "core/fitting/valve/ray_likelihood.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/valve/valve_tracer.h"

namespace foresight {
namespace {

constexpr double kUniform = 1.0 / 3.0;  // per metre: a return from anywhere within 3 m
constexpr double kHit = 0.93;           // a spot on the template returns from it
constexpr double kGoodReturn = 0.9;     // ... and has no other reason to be wrong
constexpr double kWallShare = 0.7;      // of the rays that miss
constexpr double kMixing = 0.75;        // a spot on two surfaces reads in between, else one of them

double NormalDensity(double error, double sigma) {
  const double ratio = error / sigma;
  return ratio * ratio > 60.0 ? 0.0 : 0.3989422804014327 / sigma * std::exp(-0.5 * ratio * ratio);
}

}  // namespace

RayLikelihood::RayLikelihood(const RaySet& rays, const std::optional<Plane>& wall)
    : rays_(rays), wall_(wall), spots_(rays, wall) {
  backgrounds_.reserve(rays.rays.size());
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    Background background;
    background.density = kUniform;
    if (wall)
      background.density =
          kWallShare * NormalDensity(rays.rays[i].range_m - spots_.WallRange(i), spots_.Sigma()) +
          (1.0 - kWallShare) * kUniform;
    background.log_density = std::log(background.density);
    background.reach_m = spots_.Reach(i);
    backgrounds_.push_back(background);
  }
}

double RayLikelihood::DensityOn(std::size_t i, const ExpectedRange& expected) const {
  const double range_m = rays_.rays[i].range_m;
  const double background = backgrounds_[i].density;
  if (expected.gap_m <= 0.0) {
    // The stronger of two returns is reported: that of the larger part of the spot.
    const double hit = kHit * std::clamp(1.5 * expected.share - 0.1, 0.0, 1.0);
    const double on_valve =
        kGoodReturn * NormalDensity(range_m - expected.range_m, expected.sigma_m) +
        (1.0 - kGoodReturn) * kUniform;
    return hit * on_valve + (1.0 - hit) * background;
  }
  const double between = NormalDensity(range_m - expected.range_m, expected.sigma_m);
  const double either =
      expected.share * NormalDensity(range_m - expected.valve_m, spots_.Sigma()) +
      (1.0 - expected.share) * NormalDensity(range_m - spots_.WallRange(i), spots_.Sigma());
  // From the share of good returns beside the template to that on it, without a step.
  const double good = kWallShare + (kHit * kGoodReturn - kWallShare) * expected.share;
  const double missed = (1.0 - kHit) * expected.share;
  return good * (kMixing * between + (1.0 - kMixing) * either) + missed * background +
         (1.0 - good - missed) * kUniform;
}

double RayLikelihood::operator()(const ValveCandidate& valve, ValveParts parts) const {
  const ValveTracer tracer(valve, parts);
  double sum = 0.0;
  for (std::size_t i = 0; i < backgrounds_.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    double log_density = backgrounds_[i].log_density;
    if (tracer.Near(ray, backgrounds_[i].reach_m)) {
      const ExpectedRange expected = spots_.Expect(i, tracer.Meet(ray), valve.brightness);
      if (expected.share > 0.0) log_density = std::log(DensityOn(i, expected));
    }
    sum += log_density;
  }
  return rays_.samples_per_ray * sum + LogPrior(valve, wall_);
}

double RayLikelihood::Nothing() const {
  double sum = 0.0;
  for (const Background& background : backgrounds_) sum += background.log_density;
  return rays_.samples_per_ray * sum;
}

}  // namespace foresight
