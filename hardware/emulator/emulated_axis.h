#pragma once

#include <memory>

#include "hardware/simulated/simulated_shaft.h"

namespace foresight {

/// What a drive turns: the shared shaft between its mechanical stops, and where the drive thinks it
/// should be. The two differ only while something holds the shaft. Times are the shaft's and never
/// decrease.
class EmulatedAxis {
 public:
  EmulatedAxis(std::shared_ptr<SimulatedShaft> shaft, double end_stop_rad, double time_s);

  void Move(double time_s, double target_rad, double speed_rad_s, double acceleration_rad_s2);
  void Stop(double time_s, double acceleration_rad_s2);
  /// Lets the mechanical stops act; once a cycle.
  void Update(double time_s);

  /// Something holds the shaft where it is.
  void Block(double time_s);
  void Release(double time_s);

  double AngleAt(double time_s) const { return shaft_->At(time_s).angle_rad; }
  double SpeedAt(double time_s) const { return shaft_->At(time_s).speed_rad_s; }
  /// Whether the drive still wants to move.
  bool Demanding(double time_s) const { return time_s < demand_.end_s(); }
  /// How far the shaft is from where the drive wants it.
  double FollowingError(double time_s) const;
  /// The drive takes the shaft as it is.
  void AcceptPosition(double time_s);

 private:
  /// Whether the shaft may move towards `target_rad` from where it is.
  bool Free(double time_s, double target_rad) const;
  void Hold(double time_s);

  std::shared_ptr<SimulatedShaft> shaft_;
  double end_stop_rad_;
  bool blocked_ = false;
  MotionProfile demand_;
};

}  // namespace foresight
