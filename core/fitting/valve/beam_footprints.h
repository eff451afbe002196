#pragma once

#include <optional>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_tracer.h"
#include "core/geometry/plane.h"

namespace foresight {

/// What a beam should read that intersects a valve, or passes close by.
struct ExpectedRange {
  double fraction = 0.0;  ///< of the beam's footprint that lies on the valve, 0 to 1
  double range_m =
      0.0;  ///< between the valve and the wall behind it where the footprint is on both
  double sigma_m = 0.0;  ///< of the range: the device's noise, the template's error, the mixing
  double valve_m = 0.0;  ///< range of the valve alone
  double gap_m = 0.0;    ///< from there to the wall along the ray; 0 = they do not mix
};

/// The footprints of a set of rays. A lidar's footprint at 2 m is as wide as a rim's tube: its
/// range then lies between tube and wall, and a fit that takes it for the tube's is drawn to the
/// wall by centimetres. Made once for a set of rays: each looks at its neighbours, O(rays^2).
class BeamFootprints {
 public:
  /// `rays` must outlive this.
  BeamFootprints(const RaySet& rays, const std::optional<Plane>& wall);

  const RaySet& Rays() const { return rays_; }
  const std::optional<Plane>& Wall() const { return wall_; }

  /// Half the footprint's extent along `across`, at the ray's range, with the template's own error.
  double HalfWidth(std::size_t i, const Eigen::Vector3d& across) const;
  /// The largest HalfWidth in any direction.
  double Reach(std::size_t i) const;
  /// A footprint of which less than `least_fraction` lies on the valve is treated as if that much
  /// did.
  ExpectedRange Expect(std::size_t i, const ValveIntersection& intersection, double brightness,
                       double least_fraction = 0.0) const;
  /// 1e9 without a wall.
  double WallRange(std::size_t i) const { return footprints_[i].wall_m; }
  /// False where the rays next to this one end on something before the wall: what a footprint mixes
  /// with there is not known.
  bool BeforeWall(std::size_t i) const { return footprints_[i].before_wall; }
  double Sigma() const { return sigma_m_; }
  /// How far off a range may be that agrees with `expected`: as far as most ranges of the wall are,
  /// whose errors may have longer tails than a normal distribution's.
  double Agreement(const ExpectedRange& expected) const;

 private:
  /// Half extents for a metre of range, in base.
  struct Footprint {
    Eigen::Vector3d along_line = Eigen::Vector3d::Zero();
    Eigen::Vector3d across_line = Eigen::Vector3d::Zero();
    double wall_m = 1e9;
    bool before_wall = true;
  };

  void LookBehind();
  void MeasureTail();

  const RaySet& rays_;
  std::optional<Plane> wall_;
  double sigma_m_;
  double tail_ = 1.0;  ///< how much further off than normal errors the worst ones are
  std::vector<Footprint> footprints_;
};

}  // namespace foresight
