#pragma once

#include <cmath>
#include <span>

#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

/// How a beam's range is distributed, the same in every fit's likelihood so that they judge alike.
struct BeamModel {
  static constexpr double kUniform = 1.0 / 3.0;  ///< per metre: a return from anywhere within 3 m
  static constexpr double kHit = 0.93;        ///< a beam that intersects a template returns from it
  static constexpr double kGoodReturn = 0.9;  ///< ... and has no other reason to be wrong
  static constexpr double kMapWithBeams = 0.3;   ///< of a dense map's own worth, beside its beams
  static constexpr double kPlaneFraction = 0.7;  ///< of the beams that miss: they end on a plane
  static constexpr double kAgreeSigmas = 3.0;    ///< a range this near to what it should be agrees
};

/// Normal density of an error, per metre; exactly 0 beyond 7.7 sigma.
inline double NormalDensity(double error_m, double sigma_m) {
  const double ratio = error_m / sigma_m;
  return ratio * ratio > 60.0 ? 0.0 : 0.3989422804014327 / sigma_m * std::exp(-0.5 * ratio * ratio);
}

/// Density of a ray's range where only planes are: the first one that a ray intersects hides the
/// others, but a table ends somewhere, so each has its fraction.
double BackgroundDensity(const RangeRay& ray, std::span<const Plane> planes, double sigma_m);

}  // namespace foresight
