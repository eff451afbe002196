#pragma once

#include <span>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/sampled_coverage.h"
#include "core/fitting/solids/image_edges.h"
#include "core/fitting/solids/solid_tracer.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// Solids at a place as the beam model asks for them, with how deep a ray enters.
IntersectBeam IntersectionWith(SolidTracer solids);

/// Their coverage: a quarter of a round footprint suffices for half of its beams.
CoverBeam CoverBy(SolidTracer solids);
/// The same of all rays at once, which takes a fraction of the time.
CoverBeams CoverAllBy(const SolidTracer& solids);

/// Log likelihood of solids at a place in nats: of the rays, and of the image where one shows the
/// region (RaySet::image), on whose edges their outline must lie.
double LogLikelihoodOf(std::span<const SolidPart> parts,
                       const Rigid<frame::Base, frame::Object>& base_from_object,
                       const BeamLikelihood& likelihood);

/// What the image says of their outline; nothing where there is none.
OutlineSupport OfImage(std::span<const SolidPart> parts,
                       const Rigid<frame::Base, frame::Object>& base_from_object,
                       const RaySet& rays);

/// The rays that pass within `reach_m` of solids alone, without beams and image.
RaySet RaysNear(const RaySet& rays, std::span<const SolidPart> parts,
                const Rigid<frame::Base, frame::Object>& base_from_object, double reach_m);

}  // namespace foresight
