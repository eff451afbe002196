#pragma once

#include <cstddef>
#include <optional>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_state.h"
#include "core/fitting/valve/valve_tracer.h"
#include "core/geometry/plane.h"

namespace foresight {

/// How much of a beam lies on the part of a valve that its ray intersects or passes: the slice of
/// its footprint across that part, and the mean depth of the part's round front in it.
BeamCoverage CoverageOf(const BeamFootprints& footprints, std::size_t ray,
                        const ValveIntersection& intersection, double brightness);

/// A valve at its place.
CoverBeam CoverBy(const ValveCandidate& valve, ValveParts parts = ValveParts::kAll);

/// The beams of a valve: footprints that mix with its wall where they reach that.
BeamFootprints ValveFootprints(const RaySet& rays, const std::optional<Plane>& wall);
BeamLikelihood ValveLikelihood(const RaySet& rays, const std::optional<Plane>& wall);

/// Log likelihood of a valve, with its prior, in nats.
double ScoreOf(const ValveCandidate& valve, const BeamLikelihood& likelihood,
               ValveParts parts = ValveParts::kAll);

}  // namespace foresight
