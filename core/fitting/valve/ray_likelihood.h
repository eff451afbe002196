#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/valve/beam_footprints.h"
#include "core/fitting/valve/valve_state.h"
#include "core/geometry/plane.h"

namespace foresight {

/// How well a valve explains every ray of a region: those that should intersect it, and those that
/// went past or through it. The same rays score every template, so scores compare directly.
///
/// A beam whose footprint lies on the template returns its range (or something nearer, or nonsense)
/// with probability 0.93; a footprint that is half on the wall returns a range in between, or
/// either one; all others return the wall or anything. Points alone could not tell: more spokes
/// always explain more of them, and a template hanging in empty space costs nothing.
///
/// Where the beams behind a dense map are known they count in full, and the map, which was made
/// from them, for kMapWithBeams of its own.
class RayLikelihood {
 public:
  /// `rays` must outlive this.
  RayLikelihood(const RaySet& rays, const std::optional<Plane>& wall);

  /// Log likelihood of all rays in nats, counted as independent measurements, plus the log prior.
  double operator()(const ValveCandidate& valve, ValveParts parts = ValveParts::kAll) const;

  /// The same with no valve there at all.
  double Nothing() const;

  const RaySet& Measured() const { return rays_.Measured(); }
  /// How much each of the measured rays speaks for a valve against none, in nats.
  Eigen::VectorXd Gains(const ValveCandidate& valve) const;
  /// How many deviations `first` is ahead of `second` when the scan lines of what was measured, and
  /// not its rays, are independent (DeviationsOverLines).
  double DeviationsAhead(const ValveCandidate& first, const ValveCandidate& second) const;

  /// Of its rays, without the beams behind a map.
  const BeamFootprints& Footprints() const { return footprints_; }
  /// Of Measured().
  const BeamFootprints& MeasuredFootprints() const {
    return beams_ ? beams_->MeasuredFootprints() : footprints_;
  }

 private:
  /// Density of the measured range of a ray without a valve.
  struct Background {
    double density = 0.0;
    double log_density = 0.0;
    double reach_m = 0.0;  ///< a valve further from the ray than this changes nothing
  };

  /// Of the rays alone, without beams and prior.
  double OfRays(const ValveCandidate& valve, ValveParts parts) const;
  Eigen::VectorXd LogDensities(const ValveCandidate& valve, ValveParts parts) const;
  double OfNothing() const;
  double DensityOn(std::size_t i, const ExpectedRange& expected) const;

  const RaySet& rays_;
  BeamFootprints footprints_;
  std::vector<Background> backgrounds_;
  std::unique_ptr<const RayLikelihood> beams_;  ///< behind a dense map; null = not known
};

}  // namespace foresight
