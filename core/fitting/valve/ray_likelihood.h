#pragma once

#include <optional>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_state.h"
#include "core/geometry/plane.h"

namespace foresight {

/// How well a valve explains every ray of a region: those that should meet it, and those that went
/// past or through it. The same rays score every template, so scores compare directly.
///
/// A ray that meets the template returns its range (or something nearer, or nonsense) with
/// probability 0.93; one that passes at a distance may have touched it with its footprint; all
/// others return the wall or anything. Points alone could not tell: more spokes always explain more
/// of them, and a template hanging in empty space costs nothing.
class RayLikelihood {
 public:
  RayLikelihood(const RaySet& rays, const std::optional<Plane>& wall);

  /// Log likelihood of all rays in nats, counted as independent measurements, plus the log prior.
  double operator()(const ValveCandidate& valve, ValveParts parts = ValveParts::kAll) const;

  /// The same with no valve there at all.
  double Nothing() const;

 private:
  struct RayNoise {
    double sigma_m = 0.0;     ///< of the range, with the template's own inaccuracy
    double width_m = 0.0;     ///< how far beside the ray its footprint still touches
    double background = 0.0;  ///< density of the measured range without a valve
    double log_background = 0.0;
  };

  const RaySet& rays_;
  std::vector<RayNoise> noise_;
};

}  // namespace foresight
