#include "core/fitting/solids/solid_coverage.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/fitting/beam_model.h"

namespace foresight {
namespace {

// A ray that just misses a solid returns from it every other time.
constexpr double kGrazing = 0.5 / BeamModel::kHit;
constexpr double kReachWidths = 3.5;

}  // namespace

IntersectBeam IntersectionWith(SolidTracer solids) {
  return [solids = std::move(solids)](const RangeRay& ray,
                                      double reach_m) -> std::optional<BeamIntersection> {
    const SolidIntersection intersection = solids.IntersectWithDepth(ray, reach_m);
    if (intersection.part < 0) return std::nullopt;
    return BeamIntersection{intersection.clearance_m, intersection.range_m};
  };
}

CoverBeam CoverByRays(SolidTracer solids) {
  return [solids = std::move(solids)](const BeamFootprints& footprints,
                                      std::size_t i) -> std::optional<BeamCoverage> {
    const double width_m = footprints.HalfWidth(i) + footprints.Options().edge_error_m;
    const SolidIntersection intersection =
        solids.Intersect(footprints.Rays().rays[i], kReachWidths * width_m);
    if (intersection.part < 0) return std::nullopt;
    const double ratio = intersection.clearance_m / width_m;
    const double fraction = intersection.Hits() ? 1.0 : kGrazing * std::exp(-0.5 * ratio * ratio);
    return BeamCoverage{fraction, intersection.range_m};
  };
}

double LogLikelihoodOf(std::span<const SolidPart> parts,
                       const Rigid<frame::Base, frame::Object>& base_from_object,
                       const BeamLikelihood& likelihood) {
  return OfImage(parts, base_from_object, likelihood.rays()).nats +
         likelihood(CoverByRays(SolidTracer(parts, base_from_object)));
}

OutlineSupport OfImage(std::span<const SolidPart> parts,
                       const Rigid<frame::Base, frame::Object>& base_from_object,
                       const RaySet& rays) {
  return rays.image ? rays.image->SupportOf(parts, base_from_object) : OutlineSupport();
}

RaySet RaysNear(const RaySet& rays, std::span<const SolidPart> parts,
                const Rigid<frame::Base, frame::Object>& base_from_object, double reach_m) {
  const SolidTracer tracer(parts, base_from_object);
  RaySet near = rays;
  near.rays.clear();
  near.beams = nullptr;
  near.image = nullptr;
  for (const RangeRay& ray : rays.rays)
    if (tracer.Intersect(ray, reach_m).part >= 0) near.rays.push_back(ray);
  return near;
}

}  // namespace foresight
