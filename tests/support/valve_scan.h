#pragma once

#include <cmath>
#include <memory>

#include "core/sensor/scan.h"
#include "core/simulation/world.h"

namespace foresight::testing {

/// A sweep of a simulated head at constant speed, as the devices would report it: lines at the
/// lidar's rate, the encoder at 240 Hz, one picture at `picture_rad`. The scan's rig is the true
/// one with the correction that a calibration would hold.
inline Scan SweepWorld(const World& world, double from_rad, double to_rad, double speed_rad_s,
                       double picture_rad) {
  const auto motor_at = [=](double time_s) { return from_rad + speed_rad_s * time_s; };
  Scan scan;
  scan.uuid = NewUuid();
  scan.simulated = true;
  scan.rig = world.true_rig();
  scan.rig.angle_correction = world.CalibratedCorrection();
  scan.plan.from_rad = from_rad;
  scan.plan.to_rad = to_rad;
  scan.plan.speed_rad_s = speed_rad_s;
  const double duration_s = (to_rad - from_rad) / speed_rad_s;
  const double period_s = world.true_rig().lidar.period_s;
  for (int i = 0; i * period_s < duration_s; ++i)
    scan.lines.push_back(world.MeasureLine(i, i * period_s, motor_at));
  for (int i = -12; i <= static_cast<int>(240.0 * (duration_s + 0.1)); ++i)
    scan.track.Add({i / 240.0, world.EncoderAngle(motor_at(i / 240.0))});
  const auto still = [=](double) { return picture_rad; };
  scan.frames.push_back(world.TakePicture(0, 0.0, 0.004, 0.0, still, {}));
  scan.state = ScanState::kComplete;
  return scan;
}

}  // namespace foresight::testing
