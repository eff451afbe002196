#include "core/fitting/valve/ray_likelihood.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/beam_model.h"
#include "core/fitting/line_covariance.h"
#include "core/fitting/valve/valve_tracer.h"

namespace foresight {
namespace {

constexpr double kMixing = 0.75;  // a footprint on two surfaces reads in between, else one of them

}  // namespace

RayLikelihood::RayLikelihood(const RaySet& rays, const std::optional<Plane>& wall)
    : rays_(rays), footprints_(rays, wall) {
  backgrounds_.reserve(rays.rays.size());
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    Background background;
    background.density = BeamModel::kUniform;
    if (wall)
      background.density =
          BeamModel::kPlaneFraction *
              NormalDensity(rays.rays[i].range_m - footprints_.WallRange(i), footprints_.Sigma()) +
          (1.0 - BeamModel::kPlaneFraction) * BeamModel::kUniform;
    background.log_density = std::log(background.density);
    background.reach_m = footprints_.Reach(i);
    backgrounds_.push_back(background);
  }
  if (rays.beams) beams_ = std::make_unique<const RayLikelihood>(*rays.beams, wall);
}

double RayLikelihood::DensityOn(std::size_t i, const ExpectedRange& expected) const {
  const double range_m = rays_.rays[i].range_m;
  const double background = backgrounds_[i].density;
  if (expected.gap_m <= 0.0) {
    // The stronger of two returns is reported: that of the larger part of the footprint.
    const double hit = BeamModel::kHit * std::clamp(1.5 * expected.fraction - 0.1, 0.0, 1.0);
    const double on_valve =
        BeamModel::kGoodReturn * NormalDensity(range_m - expected.range_m, expected.sigma_m) +
        (1.0 - BeamModel::kGoodReturn) * BeamModel::kUniform;
    return hit * on_valve + (1.0 - hit) * background;
  }
  const double between = NormalDensity(range_m - expected.range_m, expected.sigma_m);
  const double either =
      expected.fraction * NormalDensity(range_m - expected.valve_m, footprints_.Sigma()) +
      (1.0 - expected.fraction) *
          NormalDensity(range_m - footprints_.WallRange(i), footprints_.Sigma());
  // From the fraction of good returns beside the template to that on it, without a step.
  const double good =
      BeamModel::kPlaneFraction +
      (BeamModel::kHit * BeamModel::kGoodReturn - BeamModel::kPlaneFraction) * expected.fraction;
  const double missed = (1.0 - BeamModel::kHit) * expected.fraction;
  return good * (kMixing * between + (1.0 - kMixing) * either) + missed * background +
         (1.0 - good - missed) * BeamModel::kUniform;
}

double RayLikelihood::operator()(const ValveCandidate& valve, ValveParts parts) const {
  const double prior = LogPrior(valve, footprints_.Wall());
  if (!beams_) return OfRays(valve, parts) + prior;
  return BeamModel::kMapWithBeams * OfRays(valve, parts) + beams_->OfRays(valve, parts) + prior;
}

double RayLikelihood::OfRays(const ValveCandidate& valve, ValveParts parts) const {
  return rays_.samples_per_ray * LogDensities(valve, parts).sum();
}

Eigen::VectorXd RayLikelihood::LogDensities(const ValveCandidate& valve, ValveParts parts) const {
  const ValveTracer tracer(valve, parts);
  Eigen::VectorXd log_densities(std::ssize(backgrounds_));
  for (std::size_t i = 0; i < backgrounds_.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    double log_density = backgrounds_[i].log_density;
    const double reach_m = backgrounds_[i].reach_m;
    if (tracer.Near(ray, reach_m)) {
      const ValveIntersection intersection = tracer.Intersect(ray, reach_m);
      if (intersection.Clearance() <= reach_m) {
        const ExpectedRange expected = footprints_.Expect(i, intersection, valve.brightness);
        if (expected.fraction > 0.0) log_density = std::log(DensityOn(i, expected));
      }
    }
    log_densities(static_cast<Eigen::Index>(i)) = log_density;
  }
  return log_densities;
}

Eigen::VectorXd RayLikelihood::Gains(const ValveCandidate& valve) const {
  if (beams_) return beams_->Gains(valve);
  Eigen::VectorXd gains = LogDensities(valve, ValveParts::kAll);
  for (std::size_t i = 0; i < backgrounds_.size(); ++i)
    gains(static_cast<Eigen::Index>(i)) -= backgrounds_[i].log_density;
  return rays_.samples_per_ray * gains;
}

double RayLikelihood::DeviationsAhead(const ValveCandidate& first,
                                      const ValveCandidate& second) const {
  return DeviationsOverLines(Measured().rays, Gains(first) - Gains(second));
}

double RayLikelihood::Nothing() const {
  return beams_ ? BeamModel::kMapWithBeams * OfNothing() + beams_->OfNothing() : OfNothing();
}

double RayLikelihood::OfNothing() const {
  double sum = 0.0;
  for (const Background& background : backgrounds_) sum += background.log_density;
  return rays_.samples_per_ray * sum;
}

}  // namespace foresight
