#include "core/fitting/beam_likelihood.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/fitting/beam_model.h"
#include "core/fitting/line_covariance.h"
#include "core/fitting/line_normals.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr double kPulse_m = 0.5;           // surfaces closer than this merge into one return
constexpr double kMixing = 0.75;           // a footprint on two surfaces reads in between, else one
constexpr double kFractionError = 0.08;    // of the part of a footprint that lies on the object
constexpr double kBrightnessError = 0.30;  // how much more light an object returns is not known
constexpr double kLeastFraction = 1e-3;

}  // namespace

BeamLikelihood::BeamLikelihood(RaySet rays, std::span<const Plane> background,
                               const BeamLikelihoodOptions& options)
    : rays_(std::move(rays)),
      options_(options),
      sigma_m_(std::hypot(rays_.sigma_m, options.shape_error_m)) {
  const std::vector<Eigen::Vector3d> normals =
      options.samples > 1 ? LineNormalsOf(rays_) : std::vector<Eigen::Vector3d>();
  beams_.reserve(rays_.rays.size());
  for (std::size_t i = 0; i < rays_.rays.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    Beam beam;
    beam.half_m = 0.5 * rays_.footprint_rad * ray.range_m;
    beam.background = BackgroundDensity(ray, background, sigma_m_);
    beam.log_background = std::log(beam.background);
    beam.background_m = background.empty() ? 1e9 : RangeToPlane(ray, background.front());
    if (!normals.empty() && !normals[i].isZero()) {
      const double spacing_rad = rays_.footprint_height_rad / options.samples;
      for (int k = 0; k < options.samples; ++k)
        beam.directions.push_back(
            (ray.direction + (k - 0.5 * (options.samples - 1)) * spacing_rad * normals[i])
                .normalized());
    }
    beams_.push_back(std::move(beam));
  }
  if (rays_.beams)
    behind_map_ = std::make_shared<const BeamLikelihood>(*rays_.beams, background, options);
}

std::optional<ExpectedBeam> BeamLikelihood::Expect(std::size_t i,
                                                   const IntersectBeam& object) const {
  const Beam& beam = beams_[i];
  const RangeRay& ray = rays_.rays[i];
  const double shift_m = options_.early_return * beam.half_m;
  const double width_m = 0.5 * beam.half_m + options_.edge_error_m;
  const double reach_m = shift_m + options_.reach_widths * width_m;
  double fraction = 0.0, object_m = 0.0;
  const auto add = [&](const std::optional<BeamIntersection>& intersection) {
    if (!intersection || intersection->clearance_m > reach_m) return;
    const double beyond = (intersection->clearance_m - shift_m) / width_m;
    const double part = 0.5 * std::erfc(beyond / std::numbers::sqrt2);
    if (!(part > 0.0)) return;
    fraction += part;
    object_m += part / fraction * (intersection->range_m - object_m);  // a weighted mean so far
  };
  if (beam.directions.empty()) {
    add(object(ray, reach_m));
  } else {
    const double side_m = 0.5 * rays_.footprint_height_rad * ray.range_m;
    const auto middle = object(ray, reach_m + side_m);
    if (!middle) return std::nullopt;
    RangeRay sample = ray;
    for (std::size_t k = 0; k < beam.directions.size(); ++k) {
      sample.direction = beam.directions[k];
      add(2 * k + 1 == beam.directions.size() ? middle : object(sample, reach_m));
    }
  }
  const double samples =
      beam.directions.empty() ? 1.0 : static_cast<double>(beam.directions.size());
  if (!(fraction > 0.0)) return std::nullopt;
  ExpectedBeam expected;
  expected.object_m = expected.range_m = object_m;
  expected.fraction = fraction / samples;
  expected.sigma_m = sigma_m_;
  const double gap_m = beam.background_m - expected.object_m;
  if (!options_.mixed_ranges || !(gap_m > 0.0) || gap_m > kPulse_m ||
      expected.fraction < kLeastFraction)
    return expected;
  const double beside = 1.0 - expected.fraction;
  const double unsure =
      std::min(beside, kFractionError) + kBrightnessError * beside * expected.fraction;
  expected.mixed = true;
  expected.range_m += beside * gap_m;
  const double spread_m = gap_m * unsure;
  expected.sigma_m = std::sqrt(sigma_m_ * sigma_m_ + spread_m * spread_m);
  return expected;
}

double BeamLikelihood::DensityOf(std::size_t i, const ExpectedBeam& expected) const {
  const Beam& beam = beams_[i];
  const double range_m = rays_.rays[i].range_m;
  if (!expected.mixed) {
    const double hit = BeamModel::kHit * expected.fraction;
    const double on_object =
        BeamModel::kGoodReturn * NormalDensity(range_m - expected.range_m, sigma_m_) +
        (1.0 - BeamModel::kGoodReturn) * BeamModel::kUniform;
    return hit * on_object + (1.0 - hit) * beam.background;
  }
  const double between = NormalDensity(range_m - expected.range_m, expected.sigma_m);
  const double either =
      expected.fraction * NormalDensity(range_m - expected.object_m, sigma_m_) +
      (1.0 - expected.fraction) * NormalDensity(range_m - beam.background_m, sigma_m_);
  // From the fraction of good returns beside the object to that on it, without a step.
  const double good =
      BeamModel::kPlaneFraction +
      (BeamModel::kHit * BeamModel::kGoodReturn - BeamModel::kPlaneFraction) * expected.fraction;
  const double missed = (1.0 - BeamModel::kHit) * expected.fraction;
  return good * (kMixing * between + (1.0 - kMixing) * either) + missed * beam.background +
         (1.0 - good - missed) * BeamModel::kUniform;
}

double BeamLikelihood::LogOfRay(std::size_t i, const IntersectBeam& object) const {
  const auto expected = Expect(i, object);
  return expected ? std::log(DensityOf(i, *expected)) : beams_[i].log_background;
}

double BeamLikelihood::OfRays(const IntersectBeam& object) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < beams_.size(); ++i) sum += LogOfRay(i, object);
  return rays_.samples_per_ray * sum;
}

double BeamLikelihood::DeviationsAhead(const IntersectBeam& first,
                                       const IntersectBeam& second) const {
  if (behind_map_) return behind_map_->DeviationsAhead(first, second);
  Eigen::VectorXd differences(std::ssize(beams_));
  for (std::size_t i = 0; i < beams_.size(); ++i)
    differences[static_cast<Eigen::Index>(i)] = LogOfRay(i, first) - LogOfRay(i, second);
  return DeviationsOverLines(rays_.rays, differences);
}

double BeamLikelihood::operator()(const IntersectBeam& object) const {
  const double own = OfRays(object);
  return behind_map_ ? BeamModel::kMapWithBeams * own + behind_map_->OfRays(object) : own;
}

double BeamLikelihood::OfNothing() const {
  double sum = 0.0;
  for (const Beam& beam : beams_) sum += beam.log_background;
  return rays_.samples_per_ray * sum;
}

double BeamLikelihood::Nothing() const {
  return behind_map_ ? BeamModel::kMapWithBeams * OfNothing() + behind_map_->OfNothing()
                     : OfNothing();
}

}  // namespace foresight
