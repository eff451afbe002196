#pragma once

#include <span>
#include <vector>

#include "core/sensor/sensor_rig.h"
#include "core/simulation/ray_caster.h"

namespace foresight {

/// What the lidar can see of a scene while the plate turns between two angles. `caster` outlives
/// the view.
class LidarView {
 public:
  /// Nothing nearer than this to a point hides it: a surface does not hide itself.
  static constexpr double kTolerance_m = 0.002;

  LidarView(const RayCaster& caster, const SensorRig& true_rig, double low_plate_rad,
            double high_plate_rad);

  /// 1 for each point of `in_robot` that lies within the fan and the range of the lidar for an
  /// angle of the sweep, with nothing in between. NaN points are not seen. Sizes are equal.
  void Seen(std::span<const Eigen::Vector3d> in_robot, std::span<std::uint8_t> seen) const;

 private:
  /// The plate angles, up to two, at which the plane of the fan passes through a point.
  std::vector<double> PlateAnglesThrough(const Eigen::Vector3d& in_base) const;

  const RayCaster& caster_;
  LidarModel lidar_;
  Rigid<frame::Head, frame::Lidar> head_from_lidar_;
  Rigid<frame::Robot, frame::Base> robot_from_base_;
  double low_plate_rad_;
  double high_plate_rad_;
};

}  // namespace foresight
