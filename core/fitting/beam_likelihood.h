#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/fitting/beam_footprints.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

/// An object at a place: how much of a beam's footprint lies on it. nullopt, or a fraction of 0,
/// where nothing does.
using CoverBeam =
    std::function<std::optional<BeamCoverage>(const BeamFootprints& footprints, std::size_t ray)>;

/// The same for all rays at once; a fraction of 0 where nothing does.
using CoverBeams =
    std::function<void(const BeamFootprints& footprints, std::span<BeamCoverage> of_rays)>;

/// How well one object explains every ray of a region: those that should intersect it, and those
/// that went past or through it. The one beam model of the fits (docs/adr/0024-one-beam-model.md):
/// what differs between objects is the coverage alone. The same rays score every shape, so that
/// scores compare. Points alone could not tell: more spokes always explain more of them, and a
/// template hanging in empty space costs nothing.
///
/// The part F of a footprint that lies on the object returns the object's range with probability
/// 0.93 (or something nearer, or nonsense); the rest returns one of the planes behind, or anything:
///   p(z) = 0.93 F [0.9 N(z; z_object, s) + 0.1 U] + (1 - 0.93 F) bg(z),   s^2 = sigma^2 + shape^2
/// (with BeamOptions::stronger_return min(1, 1.5 F - 0.1) for F: the larger part is reported).
/// With BeamOptions::mixed_ranges a footprint on object and first plane, less than a pulse's length
/// apart, reads a range in between, F of the way. Dense maps count for BeamModel::kMapWithBeams of
/// their own where the beams behind them are known. Cost: a coverage of each ray.
class BeamLikelihood {
 public:
  /// `background` = planes in base that lie behind, the first the one that footprints mix with.
  /// Keeps a copy of the rays.
  BeamLikelihood(RaySet rays, std::span<const Plane> background, const BeamOptions& options = {});

  const RaySet& rays() const { return footprints_.Rays(); }
  const BeamFootprints& Footprints() const { return footprints_; }
  /// Of the beams behind a map alone; nullptr = not known, or the rays are beams themselves.
  const BeamLikelihood* BehindMap() const { return behind_map_.get(); }
  /// Of what was measured: the beams behind a map where they are known, else this.
  const BeamLikelihood& Measured() const { return behind_map_ ? *behind_map_ : *this; }
  /// Deviation of a range, the shape's error included.
  double Sigma() const { return footprints_.Sigma(); }

  /// Log likelihood of all rays in nats, counted as independent measurements.
  double operator()(const CoverBeam& object) const;
  double operator()(const CoverBeams& object) const;
  /// The same with nothing there but the planes.
  double Nothing() const;

  /// How much each of the measured rays speaks for an object against none, in nats.
  Eigen::VectorXd Gains(const CoverBeam& object) const;
  /// How many deviations the first object is ahead of the second when the lines of what was
  /// measured, not its beams, are independent (DeviationsOverLines): a map's rows are no lines.
  double DeviationsAhead(const CoverBeam& first, const CoverBeam& second) const;

  /// nullopt for a ray whose footprint does not reach the object.
  std::optional<ExpectedBeam> Expect(std::size_t ray, const CoverBeam& object) const;

 private:
  /// Density of a ray's measured range without an object.
  struct Background {
    double density = 0.0;
    double log_density = 0.0;
  };

  double OfRays(const CoverBeam& object) const;
  double OfRays(const CoverBeams& object) const;
  template <class Cover>
  double WithBeamsBehind(const Cover& object) const;
  double LogOfRay(std::size_t ray, const BeamCoverage& coverage) const;
  double OfNothing() const;
  double DensityOf(std::size_t ray, const ExpectedBeam& expected) const;

  BeamFootprints footprints_;
  std::vector<Background> backgrounds_;
  std::shared_ptr<const BeamLikelihood> behind_map_;  ///< null = not known
};

}  // namespace foresight
