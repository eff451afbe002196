#pragma once

#include <array>

namespace foresight {

/// A move of one axis with limited acceleration: braking if it was moving, then a trapezoid to the
/// target. Radians and seconds on the head's clock.
class MotionProfile {
 public:
  struct State {
    double angle_rad = 0.0;
    double speed_rad_s = 0.0;
  };

  /// At rest for ever.
  explicit MotionProfile(double angle_rad = 0.0) : rest_rad_(angle_rad) {}
  /// Comes to rest as soon as the acceleration allows.
  static MotionProfile Stop(double start_s, State from, double acceleration_rad_s2);
  /// Comes to rest at the target. Speed and acceleration are positive.
  static MotionProfile Move(double start_s, State from, double target_rad, double speed_rad_s,
                            double acceleration_rad_s2);

  double start_s() const { return start_s_; }
  double end_s() const { return end_s_; }
  /// Where the axis is; before the start, where it began.
  State At(double time_s) const;

 private:
  struct Phase {
    double duration_s = 0.0;
    double acceleration_rad_s2 = 0.0;
  };

  void Append(const Phase& phase);

  double start_s_ = 0.0;
  double end_s_ = 0.0;
  State from_;
  double rest_rad_ = 0.0;
  std::array<Phase, 4> phases_{};
  int count_ = 0;
};

}  // namespace foresight
