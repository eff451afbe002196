#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

/// How a ray passes an object: all that a beam's likelihood has to know of its geometry.
struct BeamIntersection {
  /// Least distance between ray and object in metres; negative where the ray enters it: how deep.
  double clearance_m = 0.0;
  double range_m = 0.0;  ///< where the ray enters the object, or passes it closest
};

/// An object at a place, in base. nullopt where the ray stays further than `reach_m` from it.
using IntersectBeam =
    std::function<std::optional<BeamIntersection>(const RangeRay& ray, double reach_m)>;

/// What a beam should read before an object at a place.
struct ExpectedBeam {
  double fraction = 0.0;  ///< of its footprint that lies on the object, 0 to 1
  double object_m = 0.0;  ///< range of the object alone
  double range_m = 0.0;   ///< between that and the background where a footprint mixes both
  double sigma_m = 0.0;   ///< of range_m
  bool mixed = false;
};

struct BeamLikelihoodOptions {
  double shape_error_m = 0.005;  ///< no real thing is its template
  double edge_error_m = 0.003;   ///< ... nor has its outline
  /// Part of half a sample's width that must lie on the object beyond its middle before half of the
  /// beams return from it: 0 = an edge through the middle; 0.5 = a quarter of the sample suffices.
  double early_return = 0.5;
  double reach_widths = 3.0;  ///< an object further from a ray than this changes nothing
  /// Samples across a scan line, of a footprint whose height is known; each as wide as the beams
  /// are apart. 1 = a round footprint.
  int samples = 1;
  /// A footprint on object and background reads a range in between. Else it reads one of both.
  bool mixed_ranges = false;
};

/// How well one object explains every ray of a region. The one beam model of the fits
/// (docs/adr/0024-one-beam-model.md): what differs between objects is the intersection alone.
///
/// A footprint is sampled. The part F of it that lies on the object returns the object's range with
/// probability 0.93 (or something nearer, or nonsense); the rest returns one of the planes behind,
/// or anything:
///   p(z) = 0.93 F [0.9 N(z; z_object, s) + 0.1 U] + (1 - 0.93 F) bg(z),   s^2 = sigma^2 + shape^2
/// With `mixed_ranges` a footprint on object and first plane, less than a pulse's length apart,
/// reads a range in between, F of the way. Dense maps count for BeamModel::kMapWithBeams of their
/// own where the beams behind them are known. Cost: `samples` intersections a ray near the object.
class BeamLikelihood {
 public:
  /// `background` = planes in base that lie behind, the first the one that footprints mix with.
  /// Keeps a copy of the rays.
  BeamLikelihood(RaySet rays, std::span<const Plane> background,
                 const BeamLikelihoodOptions& options = {});

  const RaySet& rays() const { return rays_; }
  /// Of the beams behind a map alone; nullptr = not known, or the rays are beams themselves.
  const BeamLikelihood* BehindMap() const { return behind_map_.get(); }
  /// Deviation of a range, the shape's error included.
  double Sigma() const { return sigma_m_; }

  /// Log likelihood of all rays in nats, counted as independent measurements.
  double operator()(const IntersectBeam& object) const;
  /// The same with nothing there but the planes.
  double Nothing() const;

  /// How many deviations the first object is ahead of the second when the lines of the scan, not
  /// its beams, are independent (DeviationsOverLines). Of the beams behind a map where they are
  /// known.
  double DeviationsAhead(const IntersectBeam& first, const IntersectBeam& second) const;

  /// nullopt for a ray whose footprint does not reach the object.
  std::optional<ExpectedBeam> Expect(std::size_t ray, const IntersectBeam& object) const;

 private:
  struct Beam {
    double half_m = 0.0;      ///< half a sample's width at the measured range
    double background = 0.0;  ///< density of the measured range without an object
    double background_m = 0;  ///< range of the first plane
    double log_background = 0.0;
    std::vector<Eigen::Vector3d> directions;  ///< of the samples beside the middle
  };

  double OfRays(const IntersectBeam& object) const;
  double LogOfRay(std::size_t ray, const IntersectBeam& object) const;
  double OfNothing() const;
  double DensityOf(std::size_t ray, const ExpectedBeam& expected) const;

  RaySet rays_;
  BeamLikelihoodOptions options_;
  double sigma_m_ = 0.0;
  std::vector<Beam> beams_;
  std::shared_ptr<const BeamLikelihood> behind_map_;  ///< null = not known
};

}  // namespace foresight
