#pragma once

#include <string>

#include "core/base/result.h"
#include "core/geometry/angles.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

/// How a head conducts a sweep.
struct CaptureOptions {
  std::string description = "head";  ///< stands in every scan as its source
  bool simulated = false;
  /// The drive's; places the run-up so that the whole scope is swept at constant speed.
  double acceleration_rad_s2 = RadiansFromDegrees(400.0);
  double settle_s = 0.06;  ///< constant speed before and after the scope
  double travel_speed_rad_s = RadiansFromDegrees(30.0);  ///< to the start of a sweep
  double homing_timeout_s = 60.0;
  /// A driver asks a silent lidar again after 0.25 s, and anew on a new connection after 0.75 s.
  double lidar_timeout_s = 1.5;
  /// Of the planned lines, but for those that the ends of the scope may cut: a scan with fewer ends
  /// as interrupted. A healthy head brings them all, one with every twentieth line damaged 95 %.
  double line_floor = 0.9;
  double camera_timeout_s = 10.0;  ///< since the last frame; a simulated image takes a second
  /// An operator who has been seen once and then not for so long ends a homing or a sweep. 0 =
  /// nobody watches.
  double operator_timeout_s = 5.0;

  Status Check() const;
  HeadMotion Motion() const { return {acceleration_rad_s2, settle_s, travel_speed_rad_s}; }
  /// From standstill to the scope, and from the scope to standstill.
  double RunUp(double speed_rad_s) const;
};

}  // namespace foresight
