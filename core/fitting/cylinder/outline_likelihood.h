#pragma once

#include <span>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// How well one solid in base explains every ray of a region, with an outline that neither pulls
/// the solid inwards nor outwards: the chance that a beam returns from it falls from 0.93 to 0 over
/// the beam's footprint, and is half of it where a quarter of the footprint still touches. How wide
/// a real footprint is is not known; the angle between neighbouring rays stands for it. Other terms
/// as in SolidLikelihood.
class OutlineLikelihood {
 public:
  /// `planes` = what lies behind. Keeps a copy of the rays.
  OutlineLikelihood(RaySet rays, std::span<const Plane> planes);

  const RaySet& rays() const { return rays_; }
  /// Log likelihood of all rays in nats, counted as independent measurements.
  double operator()(const SolidPart& solid_in_base) const;

 private:
  struct RayNoise {
    double footprint_m = 0.0;  ///< half of it, at the measured range
    double background = 0.0;   ///< density of the measured range without a solid
    double log_background = 0.0;
  };

  RaySet rays_;
  double sigma_m_ = 0.0;  ///< of a range, with how rough the solid is
  std::vector<RayNoise> noise_;
};

}  // namespace foresight
