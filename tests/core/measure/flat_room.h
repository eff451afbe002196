#pragma once

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/registration/register_scan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// A wall 2 m ahead and a floor 0.9 m below a sensor that stands 1 m above the robot's origin, seen
/// line by line; the ranges have a noise of `sigma_m`.
struct FlatRoom {
  static constexpr double kWall_m = 2.0;
  static constexpr double kFloor_m = 0.1;  ///< height in robot

  SensorRig rig = DefaultSensorRig();
  RegisteredScan cloud;

  explicit FlatRoom(double sigma_m = 0.0, double floor_tilt_rad = 0.0) {
    Random random(3);
    const Eigen::Vector3d origin = rig.robot_from_base.translation();
    sensor_ = {origin.x(), origin.y(), 1.0};
    rig.robot_from_base = {rig.robot_from_base.rotation(), sensor_};
    const auto base_from_robot = rig.robot_from_base.Inverse();
    cloud.lines = 80;
    cloud.beams = 161;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (int line = 0; line < cloud.lines; ++line) {
      cloud.origins.push_back(Eigen::Vector3f::Zero());
      for (int beam = 0; beam < cloud.beams; ++beam) {
        const double up = -1.0 + 1.4 * line / cloud.lines, left = 0.008 * (beam - 80);
        const Eigen::Vector3d way = Eigen::Vector3d(1.0, std::tan(left), std::tan(up)).normalized();
        double range = (kWall_m - sensor_.x()) / way.x();
        // z = kFloor_m + x * tan(tilt)
        const double slope = way.z() - way.x() * std::tan(floor_tilt_rad);
        const double to_floor =
            (kFloor_m + sensor_.x() * std::tan(floor_tilt_rad) - sensor_.z()) / slope;
        if (to_floor > 0.0) range = std::min(range, to_floor);
        range += sigma_m * random.Normal();
        const bool seen = beam % 40 != 7;
        cloud.range_m.push_back(seen ? static_cast<float>(range) : nan);
        cloud.intensity.push_back(0.0f);
        const Eigen::Vector3d point = base_from_robot * (sensor_ + range * way);
        cloud.points.push_back(seen ? Eigen::Vector3f(point.cast<float>())
                                    : Eigen::Vector3f(Eigen::Vector3f::Constant(nan)));
      }
    }
  }

  Eigen::Vector3d InRobot(int line, int beam) const {
    return rig.robot_from_base * cloud.points[cloud.Index(line, beam)].cast<double>();
  }
  const Eigen::Vector3d& Sensor() const { return sensor_; }

 private:
  Eigen::Vector3d sensor_ = Eigen::Vector3d::Zero();
};

}  // namespace foresight
