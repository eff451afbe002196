#pragma once

#include <deque>
#include <mutex>

#include "hardware/simulated/motion_profile.h"

namespace foresight {

/// Where the simulated motor's shaft truly is and was: the motor moves it, lidar and camera look it
/// up for the moment of each measurement. Safe from any thread.
class SimulatedShaft {
 public:
  explicit SimulatedShaft(double angle_rad) : history_{MotionProfile(angle_rad)} {}

  MotionProfile::State At(double time_s) const;
  bool MovingAt(double time_s) const;
  /// Returns when it will be at rest. Times never decrease from call to call.
  double Move(double time_s, double target_rad, double speed_rad_s, double acceleration_rad_s2);
  void Stop(double time_s, double acceleration_rad_s2);

 private:
  MotionProfile::State Find(double time_s) const;
  void Push(const MotionProfile& profile);

  mutable std::mutex mutex_;
  std::deque<MotionProfile> history_;  ///< by start; never empty
};

}  // namespace foresight
