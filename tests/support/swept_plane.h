#pragma once

#include <cmath>

#include "core/geometry/angles.h"
#include "core/geometry/plane.h"
#include "core/sensor/scan.h"

namespace foresight {

/// A noise-free scan of one plane, given in base: the motor turns at a constant speed and each beam
/// is measured where the plate is at the beam's own time.
inline Scan SweptPlane(const Plane& in_base, double from_deg, double to_deg, double speed_deg_s) {
  Scan scan;
  scan.rig = DefaultSensorRig();
  scan.plan.from_rad = RadiansFromDegrees(from_deg);
  scan.plan.to_rad = RadiansFromDegrees(to_deg);
  scan.plan.speed_rad_s = RadiansFromDegrees(speed_deg_s);
  scan.state = ScanState::kComplete;
  const double duration_s = (to_deg - from_deg) / speed_deg_s;
  const auto motor_rad = [&](double t) { return RadiansFromDegrees(from_deg + speed_deg_s * t); };
  for (double t = -0.1; t < duration_s + 0.1; t += 1.0 / 240.0) scan.track.Add({t, motor_rad(t)});
  const LidarModel& lidar = scan.rig.lidar;
  for (int line = 0; line * lidar.period_s < duration_s; ++line) {
    LidarLine measured;
    measured.seq = line;
    measured.time_s = line * lidar.period_s;
    for (int beam = 0; beam < lidar.beams; ++beam) {
      const auto base_from_lidar =
          scan.rig.BaseFromHead(motor_rad(measured.time_s + lidar.BeamTime(beam))) *
          scan.rig.HeadFromLidar();
      const double closing = in_base.normal.dot(base_from_lidar.Rotate(lidar.BeamDirection(beam)));
      const double range = -in_base.Distance(base_from_lidar.translation()) / closing;
      const bool seen = range > lidar.min_range_m && range < lidar.max_range_m;
      measured.range_mm.push_back(seen ? static_cast<std::uint16_t>(std::lround(1000.0 * range))
                                       : 1);
    }
    scan.lines.push_back(measured);
  }
  return scan;
}

}  // namespace foresight
