#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/angles.h"

namespace foresight {

/// The fan of a 2D lidar; defaults are the Hokuyo UTM-30LX-EW's. Angles are in the lidar's frame,
/// counter-clockwise seen from +z, 0 = x forward.
struct LidarModel {
  int beams = 1081;
  double first_angle_rad = RadiansFromDegrees(-135.0);  ///< beam 0
  double angle_step_rad = RadiansFromDegrees(0.25);
  double period_s = 0.025;  ///< one turn of the mirror
  double min_range_m = 0.1;
  double max_range_m = 30.0;
  double range_offset_m = 0.0;  ///< added to every range (calibration.md: estimated with the pose)
  double stamp_offset_s = 0.0;  ///< added to a line's time stamp: when beam 0 really fired

  Status Check() const;

  double BeamAngle(int beam) const { return first_angle_rad + beam * angle_step_rad; }
  /// Time of a beam after the line's stamp.
  double BeamTime(int beam) const {
    return stamp_offset_s + period_s * beam * angle_step_rad / (2.0 * std::numbers::pi);
  }
  /// Unit direction of a beam in the lidar's frame.
  Eigen::Vector3d BeamDirection(int beam) const;

  bool operator==(const LidarModel&) const = default;
};

/// One turn of the lidar as it came from the device.
struct LidarLine {
  /// Ranges below this are the device's status codes (1 = no echo, ...), never ranges.
  static constexpr std::uint16_t kFirstValidRange_mm = 23;

  std::int64_t seq = 0;  ///< counts up by one; a jump is a lost line
  double time_s = 0.0;   ///< stamp of beam 0 on the scan's clock
  std::vector<std::uint16_t> range_mm;
  std::vector<std::uint16_t> intensity;  ///< same size, or empty

  /// Metres without the calibrated offset; NaN for a status code.
  double RawRange(int beam) const;

  bool operator==(const LidarLine&) const = default;
};

}  // namespace foresight
