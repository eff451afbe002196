#include "core/fitting/beam_footprints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/line_normals.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr double kPulse_m = 0.5;         // surfaces closer than this merge into one return
constexpr double kFractionError = 0.08;  // of the part of a footprint that lies on the object
// A spoke is narrower than this neighbourhood, so that some of it ends behind the spoke.
constexpr double kNeighbourhood_rad = 0.015;
constexpr double kFarFraction = 0.8;
constexpr double kBackgroundSigmas = 4.0;
constexpr double kTailQuantile = 0.98, kTailOfNormal = 2.326;  // of |z| for a normal z
constexpr double kLongestTail = 2.5;
constexpr std::size_t kLeastBehind = 60;

}  // namespace

double SigmaOf(const RaySet& rays, const BeamOptions& options) {
  return std::hypot(rays.sigma_m, options.shape_error_m);
}

BeamFootprints::BeamFootprints(RaySet rays, std::span<const Plane> background,
                               const BeamOptions& options)
    : rays_(std::move(rays)), options_(options), sigma_m_(SigmaOf(rays_, options)) {
  if (!background.empty()) background_ = background.front();
  const std::vector<Eigen::Vector3d> normals = LineNormalsOf(rays_);
  const double spacing_rad = rays_.footprint_height_rad / options.samples;
  footprints_.resize(rays_.rays.size());
  for (std::size_t i = 0; i < footprints_.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    const Eigen::Vector3d& normal = normals[i];
    Footprint& footprint = footprints_[i];
    if (background_) footprint.background_m = RangeToPlane(ray, *background_);
    footprint.across_line = 0.5 * rays_.footprint_height_rad * normal;
    footprint.along_line = 0.5 * rays_.footprint_rad * normal.cross(ray.direction);
    if (options.samples < 2 || normal.isZero()) continue;
    for (int k = 0; k < options.samples; ++k)
      footprint.samples.push_back(
          (ray.direction + (k - 0.5 * (options.samples - 1)) * spacing_rad * normal).normalized());
  }
  AddSamples();
  if (!background_) return;
  if (options.look_behind) LookBehind();
  MeasureTail();
}

void BeamFootprints::AddSamples() {
  samples_.Reserve(footprints_.size() * static_cast<std::size_t>(options_.samples));
  for (std::size_t i = 0; i < footprints_.size(); ++i) {
    const RangeRay& ray = rays_.rays[i];
    const double reach_m = EdgeOf(i).Reach();
    if (footprints_[i].samples.empty())
      samples_.Add(ray.origin.data(), ray.direction.data(), reach_m);
    for (const Eigen::Vector3d& direction : footprints_[i].samples)
      samples_.Add(ray.origin.data(), direction.data(), reach_m);
  }
  samples_.Pad();
}

SampleEdge BeamFootprints::EdgeOf(std::size_t i) const {
  const double half_m = HalfWidth(i);
  return {options_.early_return * half_m, 0.5 * half_m + options_.edge_error_m};
}

// Nothing but noise ends behind a wall.
void BeamFootprints::MeasureTail() {
  std::vector<double> behind_m;
  for (std::size_t i = 0; i < footprints_.size(); ++i) {
    const double error_m = rays_.rays[i].range_m - footprints_[i].background_m;
    if (footprints_[i].reaches_background && error_m > 0.0) behind_m.push_back(error_m);
  }
  if (behind_m.size() < kLeastBehind) return;
  const double far_m = Quantile(std::move(behind_m), kTailQuantile);
  tail_ = std::clamp(far_m / (kTailOfNormal * sigma_m_), 1.0, kLongestTail);
}

double BeamFootprints::Agreement(const ExpectedBeam& expected) const {
  const double longer = (tail_ * tail_ - 1.0) * sigma_m_ * sigma_m_;
  return BeamModel::kAgreeSigmas * std::sqrt(expected.sigma_m * expected.sigma_m + longer);
}

// A spoke that is not there would explain every return from a pipe or a body between wheel and wall
// as a footprint on itself and the wall. What such a body mixes with is not known.
void BeamFootprints::LookBehind() {
  const double cosine = std::cos(kNeighbourhood_rad);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < footprints_.size(); ++i) {
    ranges.clear();
    for (const RangeRay& other : rays_.rays)
      if (other.direction.dot(rays_.rays[i].direction) > cosine) ranges.push_back(other.range_m);
    const double far = MoveToRank(
        ranges, static_cast<std::size_t>(kFarFraction * static_cast<double>(ranges.size() - 1)));
    footprints_[i].reaches_background =
        far > footprints_[i].background_m - kBackgroundSigmas * sigma_m_;
  }
}

double BeamFootprints::HalfWidth(std::size_t i) const {
  return 0.5 * rays_.footprint_rad * rays_.rays[i].range_m;
}

double BeamFootprints::HalfHeight(std::size_t i) const {
  return 0.5 * rays_.footprint_height_rad * rays_.rays[i].range_m;
}

double BeamFootprints::HalfWidthAlong(std::size_t i, const Eigen::Vector3d& across) const {
  const Footprint& footprint = footprints_[i];
  const double edge2 = options_.edge_error_m * options_.edge_error_m;
  if (footprint.across_line.isZero()) {
    const double half_m = HalfWidth(i);
    return std::sqrt(half_m * half_m + edge2);
  }
  // As wide as an even footprint of the same variance.
  const double range_m = rays_.rays[i].range_m;
  const Eigen::Vector2d half(footprint.along_line.dot(across), footprint.across_line.dot(across));
  return std::sqrt(range_m * range_m * half.squaredNorm() + edge2);
}

double BeamFootprints::Reach(std::size_t i) const {
  const double widest = rays_.footprint_rad + rays_.footprint_height_rad;
  return 0.5 * widest * rays_.rays[i].range_m + options_.edge_error_m;
}

ExpectedBeam BeamFootprints::Expect(std::size_t i, const BeamCoverage& coverage) const {
  const double fraction = coverage.fraction;
  ExpectedBeam expected{fraction, coverage.range_m, coverage.range_m, sigma_m_, false};
  if (!options_.mixed_ranges || !(fraction > 0.0) || fraction < options_.least_mixed_fraction ||
      !ReachesBackground(i))
    return expected;
  const double gap_m = BackgroundRange(i) - expected.object_m;
  if (!(gap_m > 0.0) || gap_m > kPulse_m) return expected;
  const double light = coverage.brightness * fraction;
  const double beside = (1.0 - fraction) / (light + 1.0 - fraction);
  expected.mixed = true;
  expected.range_m += beside * gap_m;
  const double unsure =
      std::min(beside, kFractionError) + options_.brightness_error * beside * (1.0 - beside);
  expected.sigma_m = std::sqrt(sigma_m_ * sigma_m_ + gap_m * unsure * gap_m * unsure);
  return expected;
}

}  // namespace foresight
