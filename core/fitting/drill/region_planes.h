#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

using Beams = std::vector<RangeRay>;

/// Of a real surface from its plane, and of a point by the error of the motor's angle.
constexpr double kUnevenSurface_m = 0.004;

/// How far a beam that ends on the plane may end from it: ranges err along the beam, which hardly
/// moves a point on a table that is seen at a grazing angle. `sigma_m` of a range.
double OnPlaneTolerance(double sigma_m, const Plane& plane, const RangeRay& ray);
Beams EndingOn(const Beams& beams, const Plane& plane, double sigma_m);

/// The plane through the ends of three beams that most of them end on, each counted as `weight` of
/// the plane says; nullopt where all weights are 0.
std::optional<Plane> BestPlane(const Beams& beams, double sigma_m,
                               const std::function<double(const Plane&)>& weight, Random& random);

}  // namespace foresight
