#include "core/fitting/beam_likelihood.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fitting/beam_model.h"
#include "core/fitting/line_covariance.h"

namespace foresight {
namespace {

constexpr double kMixing = 0.75;  // a footprint on two surfaces reads in between, else one of both

}  // namespace

BeamLikelihood::BeamLikelihood(RaySet rays, std::span<const Plane> background,
                               const BeamOptions& options)
    : footprints_(std::move(rays), background, options) {
  backgrounds_.reserve(this->rays().rays.size());
  for (const RangeRay& ray : this->rays().rays) {
    const double density = BackgroundDensity(ray, background, Sigma());
    backgrounds_.push_back({density, std::log(density)});
  }
  if (const auto& beams = this->rays().beams)
    behind_map_ = std::make_shared<const BeamLikelihood>(*beams, background, options);
}

std::optional<ExpectedBeam> BeamLikelihood::Expect(std::size_t i, const CoverBeam& object) const {
  const std::optional<BeamCoverage> coverage = object(footprints_, i);
  if (!coverage || !(coverage->fraction > 0.0)) return std::nullopt;
  return footprints_.Expect(i, *coverage);
}

double BeamLikelihood::DensityOf(std::size_t i, const ExpectedBeam& expected) const {
  const double range_m = rays().rays[i].range_m;
  const double background = backgrounds_[i].density;
  if (!expected.mixed) {
    const double reported = footprints_.Options().stronger_return
                                ? std::clamp(1.5 * expected.fraction - 0.1, 0.0, 1.0)
                                : expected.fraction;
    const double hit = BeamModel::kHit * reported;
    const double on_object =
        BeamModel::kGoodReturn * NormalDensity(range_m - expected.range_m, expected.sigma_m) +
        (1.0 - BeamModel::kGoodReturn) * BeamModel::kUniform;
    return hit * on_object + (1.0 - hit) * background;
  }
  const double between = NormalDensity(range_m - expected.range_m, expected.sigma_m);
  const double either =
      expected.fraction * NormalDensity(range_m - expected.object_m, Sigma()) +
      (1.0 - expected.fraction) * NormalDensity(range_m - footprints_.BackgroundRange(i), Sigma());
  // From the fraction of good returns beside the object to that on it, without a step.
  const double good =
      BeamModel::kPlaneFraction +
      (BeamModel::kHit * BeamModel::kGoodReturn - BeamModel::kPlaneFraction) * expected.fraction;
  const double missed = (1.0 - BeamModel::kHit) * expected.fraction;
  return good * (kMixing * between + (1.0 - kMixing) * either) + missed * background +
         (1.0 - good - missed) * BeamModel::kUniform;
}

double BeamLikelihood::LogOfRay(std::size_t i, const BeamCoverage& coverage) const {
  return coverage.fraction > 0.0 ? std::log(DensityOf(i, footprints_.Expect(i, coverage)))
                                 : backgrounds_[i].log_density;
}

double BeamLikelihood::OfRays(const CoverBeam& object) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < backgrounds_.size(); ++i)
    sum += LogOfRay(i, object(footprints_, i).value_or(BeamCoverage()));
  return rays().samples_per_ray * sum;
}

double BeamLikelihood::OfRays(const CoverBeams& object) const {
  std::vector<BeamCoverage> covers(backgrounds_.size());
  object(footprints_, covers);
  double sum = 0.0;
  for (std::size_t i = 0; i < covers.size(); ++i) sum += LogOfRay(i, covers[i]);
  return rays().samples_per_ray * sum;
}

template <class Cover>
double BeamLikelihood::WithBeamsBehind(const Cover& object) const {
  const double own = OfRays(object);
  return behind_map_ ? BeamModel::kMapWithBeams * own + behind_map_->OfRays(object) : own;
}

double BeamLikelihood::operator()(const CoverBeam& object) const {
  return WithBeamsBehind(object);
}

double BeamLikelihood::operator()(const CoverBeams& object) const {
  return WithBeamsBehind(object);
}

Eigen::VectorXd BeamLikelihood::Gains(const CoverBeam& object) const {
  if (behind_map_) return behind_map_->Gains(object);
  Eigen::VectorXd gains(std::ssize(backgrounds_));
  for (std::size_t i = 0; i < backgrounds_.size(); ++i)
    gains[static_cast<Eigen::Index>(i)] =
        LogOfRay(i, object(footprints_, i).value_or(BeamCoverage())) - backgrounds_[i].log_density;
  return rays().samples_per_ray * gains;
}

double BeamLikelihood::DeviationsAhead(const CoverBeam& first, const CoverBeam& second) const {
  return DeviationsOverLines(Measured().rays().rays, Gains(first) - Gains(second));
}

double BeamLikelihood::OfNothing() const {
  double sum = 0.0;
  for (const Background& background : backgrounds_) sum += background.log_density;
  return rays().samples_per_ray * sum;
}

double BeamLikelihood::Nothing() const {
  return behind_map_ ? BeamModel::kMapWithBeams * OfNothing() + behind_map_->OfNothing()
                     : OfNothing();
}

}  // namespace foresight
