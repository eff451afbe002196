#include "core/fitting/solids/solid_likelihood.h"

#include <cmath>
#include <utility>

#include "core/fitting/beam_model.h"
#include "core/fitting/line_covariance.h"

namespace foresight {
namespace {

constexpr double kGrazing = 0.5;  // a ray that just misses a solid returns from it
constexpr double kReachWidths = 3.5;

}  // namespace

SolidLikelihood::SolidLikelihood(RaySet rays, std::span<const Plane> planes)
    : rays_(std::move(rays)) {
  noise_.reserve(rays_.rays.size());
  const double sigma = std::hypot(rays_.sigma_m, kDrillTemplateError_m);
  for (const RangeRay& ray : rays_.rays) {
    RayNoise noise;
    noise.sigma_m = sigma;
    noise.width_m = 0.5 * rays_.footprint_rad * ray.range_m + kDrillEdgeError_m;
    noise.background = BackgroundDensity(ray, planes, sigma);
    noise.log_background = std::log(noise.background);
    noise_.push_back(noise);
  }
  if (rays_.beams) beams_ = std::make_shared<const SolidLikelihood>(*rays_.beams, planes);
}

double SolidLikelihood::operator()(
    std::span<const SolidPart> parts,
    const Rigid<frame::Base, frame::Object>& base_from_object) const {
  const double own = OfRays(parts, base_from_object);
  const double seen = OfImage(parts, base_from_object).nats;
  return seen +
         (beams_ ? BeamModel::kMapWithBeams * own + beams_->OfRays(parts, base_from_object) : own);
}

OutlineSupport SolidLikelihood::OfImage(
    std::span<const SolidPart> parts,
    const Rigid<frame::Base, frame::Object>& base_from_object) const {
  return rays_.image ? rays_.image->SupportOf(parts, base_from_object) : OutlineSupport();
}

double SolidLikelihood::OfRays(std::span<const SolidPart> parts,
                               const Rigid<frame::Base, frame::Object>& base_from_object) const {
  const SolidTracer tracer(parts, base_from_object);
  double sum = 0.0;
  for (std::size_t i = 0; i < noise_.size(); ++i)
    sum += OfRay(i, tracer.Intersect(rays_.rays[i], kReachWidths * noise_[i].width_m));
  return rays_.samples_per_ray * sum;
}

double SolidLikelihood::OfRay(std::size_t i, const SolidIntersection& intersection) const {
  const RayNoise& noise = noise_[i];
  if (intersection.part < 0) return noise.log_background;
  const double ratio = intersection.clearance_m / noise.width_m;
  const double hit =
      intersection.Hits() ? BeamModel::kHit : kGrazing * std::exp(-0.5 * ratio * ratio);
  const double on_solid =
      BeamModel::kGoodReturn *
          NormalDensity(rays_.rays[i].range_m - intersection.range_m, noise.sigma_m) +
      (1.0 - BeamModel::kGoodReturn) * BeamModel::kUniform;
  return std::log(hit * on_solid + (1.0 - hit) * noise.background);
}

Eigen::VectorXd SolidLikelihood::LogOfRays(
    std::span<const SolidPart> parts,
    const Rigid<frame::Base, frame::Object>& base_from_object) const {
  const SolidTracer tracer(parts, base_from_object);
  Eigen::VectorXd logs(std::ssize(noise_));
  for (std::size_t i = 0; i < noise_.size(); ++i)
    logs[static_cast<Eigen::Index>(i)] =
        OfRay(i, tracer.Intersect(rays_.rays[i], kReachWidths * noise_[i].width_m));
  return rays_.samples_per_ray * logs;
}

double SolidLikelihood::DeviationsAhead(
    std::span<const SolidPart> first, const Rigid<frame::Base, frame::Object>& base_from_first,
    std::span<const SolidPart> second,
    const Rigid<frame::Base, frame::Object>& base_from_second) const {
  if (beams_) return beams_->DeviationsAhead(first, base_from_first, second, base_from_second);
  return DeviationsOverLines(
      rays_.rays, LogOfRays(first, base_from_first) - LogOfRays(second, base_from_second));
}

double SolidLikelihood::Nothing() const {
  return beams_ ? BeamModel::kMapWithBeams * OfNothing() + beams_->OfNothing() : OfNothing();
}

double SolidLikelihood::OfNothing() const {
  double sum = 0.0;
  for (const RayNoise& noise : noise_) sum += noise.log_background;
  return rays_.samples_per_ray * sum;
}

SolidLikelihood SolidLikelihood::Near(std::span<const SolidPart> parts,
                                      const Rigid<frame::Base, frame::Object>& base_from_object,
                                      double reach_m) const {
  const SolidTracer tracer(parts, base_from_object);
  SolidLikelihood near;
  near.rays_ = rays_;
  near.rays_.rays.clear();
  near.rays_.image = nullptr;
  for (std::size_t i = 0; i < noise_.size(); ++i) {
    if (tracer.Intersect(rays_.rays[i], reach_m).part < 0) continue;
    near.rays_.rays.push_back(rays_.rays[i]);
    near.noise_.push_back(noise_[i]);
  }
  return near;
}

}  // namespace foresight
