#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/fitting/ray_columns.h"
#include "core/fitting/ray_set.h"
#include "core/geometry/plane.h"

namespace foresight {

/// The part of a beam's footprint that lies on an object: all that a beam's likelihood has to know
/// of the object's geometry.
struct BeamCoverage {
  double fraction = 0.0;    ///< of the footprint, 0 to 1
  double range_m = 0.0;     ///< of that part
  double brightness = 1.0;  ///< how much more light the object returns than the background
};

/// What a beam should read before an object at a place.
struct ExpectedBeam {
  double fraction = 0.0;  ///< of its footprint that lies on the object, 0 to 1
  double object_m = 0.0;  ///< range of the object alone
  double range_m = 0.0;   ///< between that and the background where a footprint mixes both
  double sigma_m = 0.0;   ///< of range_m: the device's noise, the shape's error, the mixing
  bool mixed = false;
};

/// What differs between objects in how their beams are looked at.
struct BeamOptions {
  double shape_error_m = 0.005;  ///< no real thing is its template
  double edge_error_m = 0.003;   ///< ... nor has its outline
  /// Part of half a sample's width that must lie on the object beyond its middle before half of the
  /// beams return from it: 0 = an edge through the middle; 0.5 = a quarter of the sample suffices.
  /// Of objects of which the intersection with a ray alone is known (CoverBySamples).
  double early_return = 0.5;
  /// Samples across a scan line, of a footprint whose height is known; each as wide as the beams
  /// are apart. 1 = a round footprint.
  int samples = 1;
  /// A footprint on object and background reads a range in between. Else it reads one of both.
  bool mixed_ranges = false;
  /// The least part of a footprint that mixes.
  double least_mixed_fraction = 1e-3;
  /// How unsure it is how much more light the object returns than the background, in logarithms.
  double brightness_error = 0.30;
  /// Footprints mix only where the beams beside them reach the background.
  bool look_behind = false;
  /// Where a footprint does not mix, the stronger of two returns is reported: that of its larger
  /// part. Else each is, as often as its part is large.
  bool stronger_return = false;
};

/// Where an object's outline has to lie beside a sample of a footprint for half of the beams to
/// return from the object, and how far from there all or none do: an error function.
struct SampleEdge {
  double shift_m = 0.0;  ///< clearance of the sample's middle where half of the beams return
  double width_m = 0.0;  ///< deviation of the error function

  /// An object further from a sample than this changes nothing.
  double Reach() const { return shift_m + 3.0 * width_m; }
};

/// Deviation of a range of the object's, the shape's error included.
double SigmaOf(const RaySet& rays, const BeamOptions& options);

/// The footprints of a set of rays before planes. A lidar's footprint at 2 m is as wide as a rim's
/// tube: its range then lies between tube and wall, and a fit that takes it for the tube's is drawn
/// to the wall by centimetres. O(rays), with `look_behind` O(rays^2).
class BeamFootprints {
 public:
  /// `background` = planes in base that lie behind; the first is the one that footprints mix with.
  /// Keeps a copy of the rays.
  BeamFootprints(RaySet rays, std::span<const Plane> background, const BeamOptions& options = {});

  const RaySet& Rays() const { return rays_; }
  const BeamOptions& Options() const { return options_; }
  /// The plane that footprints mix with.
  const std::optional<Plane>& Background() const { return background_; }
  /// 1e9 without one.
  double BackgroundRange(std::size_t i) const { return footprints_[i].background_m; }
  /// False where the rays next to this one end on something before the background: what a footprint
  /// mixes with there is not known.
  bool ReachesBackground(std::size_t i) const { return footprints_[i].reaches_background; }

  /// Half a round footprint's width at the ray's range, and half a tall one's height.
  double HalfWidth(std::size_t i) const;
  double HalfHeight(std::size_t i) const;
  /// Half the footprint's extent along `across`, at the ray's range, with the outline's own error.
  double HalfWidthAlong(std::size_t i, const Eigen::Vector3d& across) const;
  /// The largest of these in any direction.
  double Reach(std::size_t i) const;
  /// Of the samples across the scan line, in base; empty where there is one alone.
  std::span<const Eigen::Vector3d> SampleDirections(std::size_t i) const {
    return footprints_[i].samples;
  }
  /// Of each of its samples, at the ray's range.
  SampleEdge EdgeOf(std::size_t i) const;
  /// All samples of all footprints, one after another: one of a footprint without SampleDirections.
  const RayColumns& Samples() const { return samples_; }

  ExpectedBeam Expect(std::size_t i, const BeamCoverage& coverage) const;
  /// SigmaOf.
  double Sigma() const { return sigma_m_; }
  /// How far off a range may be that agrees with `expected`: as far as most ranges of the
  /// background are, whose errors may have longer tails than a normal distribution's.
  double Agreement(const ExpectedBeam& expected) const;

 private:
  /// Half extents for a metre of range, in base.
  struct Footprint {
    Eigen::Vector3d along_line = Eigen::Vector3d::Zero();
    Eigen::Vector3d across_line = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> samples;
    double background_m = 1e9;
    bool reaches_background = true;
  };

  void LookBehind();
  void AddSamples();
  void MeasureTail();

  RaySet rays_;
  BeamOptions options_;
  std::optional<Plane> background_;
  double sigma_m_;
  double tail_ = 1.0;  ///< how much further off than normal errors the worst ones are
  std::vector<Footprint> footprints_;
  RayColumns samples_;
};

}  // namespace foresight
