#pragma once

#include <functional>
#include <optional>
#include <span>

#include "core/fitting/beam_likelihood.h"
#include "core/fitting/ray_set.h"

namespace foresight {

/// How a ray passes an object.
struct BeamIntersection {
  /// Least distance between ray and object in metres; negative where the ray enters it: how deep.
  double clearance_m = 0.0;
  double range_m = 0.0;  ///< where the ray enters the object, or passes it closest
};

/// An object at a place, in base. nullopt where the ray stays further than `reach_m` from it.
using IntersectBeam =
    std::function<std::optional<BeamIntersection>(const RangeRay& ray, double reach_m)>;

/// The coverage of an object of which only the intersection with a ray is known: of each sample of
/// a footprint (BeamOptions::samples) an error function of how far the ray passes from the outline,
/// whose deviation is a quarter of the sample's width and the outline's own error.
CoverBeam CoverBySamples(IntersectBeam object);

/// The same of all rays at once: clearance (infinite where a ray does not come within its reach)
/// and range, a place for each of the rays with their padding.
using IntersectBeams = std::function<void(const RayColumns& rays, std::span<double> clearance_m,
                                          std::span<double> range_m)>;

/// CoverBySamples for all rays at once.
CoverBeams CoverAllBySamples(IntersectBeams object);

}  // namespace foresight
