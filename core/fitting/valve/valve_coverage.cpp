#include "core/fitting/valve/valve_coverage.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace foresight {
namespace {

BeamOptions ValveBeams() {
  BeamOptions options;
  options.shape_error_m = 0.0045;  // no real wheel is a torus with capsules
  options.edge_error_m = 0.00275;
  options.mixed_ranges = true;
  options.least_mixed_fraction = 0.0;
  options.brightness_error = 0.15;  // over one valve; its own is fitted
  options.look_behind = true;
  options.stronger_return = true;
  return options;
}

std::span<const Plane> Background(const std::optional<Plane>& wall) {
  return wall ? std::span(&*wall, 1) : std::span<const Plane>();
}

/// Integral of sqrt(1 - x^2) from 0 to x.
double CircleArea(double x) {
  x = std::clamp(x, -1.0, 1.0);
  return 0.5 * (x * std::sqrt(1.0 - x * x) + std::asin(x));
}

}  // namespace

BeamCoverage CoverageOf(const BeamFootprints& footprints, std::size_t i,
                        const ValveIntersection& intersection, double brightness) {
  BeamCoverage coverage{0.0, intersection.Range(), brightness};
  if (intersection.part == ValvePart::kDisc) {
    coverage.fraction = 1.0;
    return coverage;
  }
  const double half = footprints.HalfWidthAlong(i, intersection.across);
  const double low = std::max(-intersection.radius_m, intersection.offset_m - half);
  const double high = std::min(intersection.radius_m, intersection.offset_m + half);
  if (!(high > low)) return coverage;
  coverage.fraction = (high - low) / (2.0 * half);
  const double r = intersection.radius_m;
  const double front =
      intersection.depth_m * r * (CircleArea(high / r) - CircleArea(low / r)) / (high - low) -
      intersection.lean * 0.5 * (low + high);
  coverage.range_m = intersection.middle_m - intersection.stretch * front;
  return coverage;
}

CoverBeam CoverBy(const ValveCandidate& valve, ValveParts parts) {
  return [tracer = ValveTracer(valve, parts), brightness = valve.brightness](
             const BeamFootprints& footprints, std::size_t i) -> std::optional<BeamCoverage> {
    const RangeRay& ray = footprints.Rays().rays[i];
    const double reach_m = footprints.Reach(i);
    if (!tracer.Near(ray, reach_m)) return std::nullopt;
    const ValveIntersection intersection = tracer.Intersect(ray, reach_m);
    if (intersection.Clearance() > reach_m) return std::nullopt;
    return CoverageOf(footprints, i, intersection, brightness);
  };
}

BeamFootprints ValveFootprints(const RaySet& rays, const std::optional<Plane>& wall) {
  return {rays, Background(wall), ValveBeams()};
}

BeamLikelihood ValveLikelihood(const RaySet& rays, const std::optional<Plane>& wall) {
  return {rays, Background(wall), ValveBeams()};
}

double ScoreOf(const ValveCandidate& valve, const BeamLikelihood& likelihood, ValveParts parts) {
  return likelihood(CoverBy(valve, parts)) + LogPrior(valve, likelihood.Footprints().Background());
}

}  // namespace foresight
