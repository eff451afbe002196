#include "core/fitting/solids/solid_coverage.h"

#include <optional>
#include <utility>

namespace foresight {

IntersectBeam IntersectionWith(SolidTracer solids) {
  return [solids = std::move(solids)](const RangeRay& ray,
                                      double reach_m) -> std::optional<BeamIntersection> {
    const SolidIntersection intersection = solids.IntersectWithDepth(ray, reach_m);
    if (intersection.part < 0) return std::nullopt;
    return BeamIntersection{intersection.clearance_m, intersection.range_m};
  };
}

CoverBeam CoverBy(SolidTracer solids) {
  return CoverBySamples(IntersectionWith(std::move(solids)));
}

CoverBeams CoverAllBy(const SolidTracer& solids) {
  return CoverAllBySamples([placed = solids.Placed()](const RayColumns& rays,
                                                      std::span<double> clearance_m,
                                                      std::span<double> range_m) {
    IntersectColumns(placed, rays, clearance_m, range_m);
  });
}

double LogLikelihoodOf(std::span<const SolidPart> parts,
                       const Rigid<frame::Base, frame::Object>& base_from_object,
                       const BeamLikelihood& likelihood) {
  return OfImage(parts, base_from_object, likelihood.rays()).nats +
         likelihood(CoverAllBy(SolidTracer(parts, base_from_object)));
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
