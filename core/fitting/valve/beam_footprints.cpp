#include "core/fitting/valve/beam_footprints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/line_normals.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr double kTemplateError_m = 0.0045;  // no real wheel is a torus with capsules
constexpr double kEdgeError_m = 0.00275;
constexpr double kPulse_m = 0.5;            // surfaces closer than this merge into one return
constexpr double kFractionError = 0.08;     // of the part of a footprint that lies on the valve
constexpr double kBrightnessSpread = 0.15;  // of the logarithm, over one valve
// A spoke is narrower than this neighbourhood, so that some of it ends behind the spoke.
constexpr double kNeighbourhood_rad = 0.015;
constexpr double kFarFraction = 0.8;
constexpr double kWallSigmas = 4.0;
constexpr double kTailQuantile = 0.98, kTailOfNormal = 2.326;  // of |z| for a normal z
constexpr double kLongestTail = 2.5;
constexpr std::size_t kLeastBehind = 60;

/// Integral of sqrt(1 - x^2) from 0 to x.
double CircleArea(double x) {
  x = std::clamp(x, -1.0, 1.0);
  return 0.5 * (x * std::sqrt(1.0 - x * x) + std::asin(x));
}

}  // namespace

BeamFootprints::BeamFootprints(const RaySet& rays, const std::optional<Plane>& wall)
    : rays_(rays), wall_(wall), sigma_m_(std::hypot(rays.sigma_m, kTemplateError_m)) {
  const std::vector<Eigen::Vector3d> normals = LineNormalsOf(rays);
  footprints_.resize(rays.rays.size());
  for (std::size_t i = 0; i < footprints_.size(); ++i) {
    const RangeRay& ray = rays.rays[i];
    if (wall) footprints_[i].wall_m = RangeToPlane(ray, *wall);
    const Eigen::Vector3d& normal = normals[i];
    footprints_[i].across_line = 0.5 * rays.footprint_height_rad * normal;
    footprints_[i].along_line = 0.5 * rays.footprint_rad * normal.cross(ray.direction);
  }
  if (!wall) return;
  LookBehind();
  MeasureTail();
}

// Nothing but noise ends behind a wall.
void BeamFootprints::MeasureTail() {
  std::vector<double> behind_m;
  for (std::size_t i = 0; i < footprints_.size(); ++i) {
    const double error_m = rays_.rays[i].range_m - footprints_[i].wall_m;
    if (footprints_[i].before_wall && error_m > 0.0) behind_m.push_back(error_m);
  }
  if (behind_m.size() < kLeastBehind) return;
  const double far_m = Quantile(std::move(behind_m), kTailQuantile);
  tail_ = std::clamp(far_m / (kTailOfNormal * sigma_m_), 1.0, kLongestTail);
}

double BeamFootprints::Agreement(const ExpectedRange& expected) const {
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
    const auto far = ranges.begin() + static_cast<std::ptrdiff_t>(
                                          kFarFraction * static_cast<double>(ranges.size() - 1));
    std::nth_element(ranges.begin(), far, ranges.end());
    footprints_[i].before_wall = *far > footprints_[i].wall_m - kWallSigmas * sigma_m_;
  }
}

double BeamFootprints::HalfWidth(std::size_t i, const Eigen::Vector3d& across) const {
  const Footprint& footprint = footprints_[i];
  const double range_m = rays_.rays[i].range_m;
  if (footprint.across_line.isZero()) {
    const double half_m = 0.5 * rays_.footprint_rad * range_m;
    return std::sqrt(half_m * half_m + kEdgeError_m * kEdgeError_m);
  }
  // As wide as an even footprint of the same variance.
  const Eigen::Vector2d half(footprint.along_line.dot(across), footprint.across_line.dot(across));
  return std::sqrt(range_m * range_m * half.squaredNorm() + kEdgeError_m * kEdgeError_m);
}

double BeamFootprints::Reach(std::size_t i) const {
  const double widest = rays_.footprint_rad + rays_.footprint_height_rad;
  return 0.5 * widest * rays_.rays[i].range_m + kEdgeError_m;
}

ExpectedRange BeamFootprints::Expect(std::size_t i, const ValveIntersection& intersection,
                                     double brightness, double least_fraction) const {
  ExpectedRange expected{0.0, intersection.Range(), sigma_m_, intersection.Range(), 0.0};
  if (intersection.part == ValvePart::kDisc) {
    expected.fraction = 1.0;
    return expected;
  }
  const double half = HalfWidth(i, intersection.across);
  const double low = std::max(-intersection.radius_m, intersection.offset_m - half);
  const double high = std::min(intersection.radius_m, intersection.offset_m + half);
  if (high > low) {
    expected.fraction = (high - low) / (2.0 * half);
    // The mean depth of the covered part of the round front.
    const double r = intersection.radius_m;
    const double front =
        intersection.depth_m * r * (CircleArea(high / r) - CircleArea(low / r)) / (high - low) -
        intersection.lean * 0.5 * (low + high);
    expected.valve_m = expected.range_m = intersection.middle_m - intersection.stretch * front;
  }
  expected.fraction = std::max(expected.fraction, least_fraction);
  const double gap = footprints_[i].before_wall ? footprints_[i].wall_m - expected.range_m : 0.0;
  if (!(gap > 0.0) || gap > kPulse_m || expected.fraction <= 0.0) return expected;
  const double light = brightness * expected.fraction;
  const double beside = (1.0 - expected.fraction) / (light + 1.0 - expected.fraction);
  expected.gap_m = gap;
  expected.range_m += beside * gap;
  const double unsure =
      std::min(beside, kFractionError) + kBrightnessSpread * beside * (1.0 - beside);
  expected.sigma_m = std::sqrt(sigma_m_ * sigma_m_ + gap * unsure * gap * unsure);
  return expected;
}

}  // namespace foresight
