#include "hardware/simulated/motion_profile.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

MotionProfile::State After(MotionProfile::State from, double duration_s, double acceleration) {
  return {from.angle_rad + duration_s * (from.speed_rad_s + 0.5 * acceleration * duration_s),
          from.speed_rad_s + acceleration * duration_s};
}

}  // namespace

void MotionProfile::Append(const Phase& phase) {
  phases_[static_cast<std::size_t>(count_++)] = phase;
  end_s_ += phase.duration_s;
}

MotionProfile MotionProfile::Stop(double start_s, State from, double acceleration_rad_s2) {
  MotionProfile profile;
  profile.start_s_ = profile.end_s_ = start_s;
  profile.from_ = from;
  const double duration_s = std::abs(from.speed_rad_s) / acceleration_rad_s2;
  const double braking = std::copysign(acceleration_rad_s2, -from.speed_rad_s);
  profile.Append({duration_s, braking});
  profile.rest_rad_ = After(from, duration_s, braking).angle_rad;
  return profile;
}

MotionProfile MotionProfile::Move(double start_s, State from, double target_rad, double speed_rad_s,
                                  double acceleration_rad_s2) {
  MotionProfile profile = Stop(start_s, from, acceleration_rad_s2);
  const double way = target_rad - profile.rest_rad_;
  const double distance = std::abs(way);
  // A short way is a triangle: half of it to speed up, half of it to brake.
  const double top = std::min(speed_rad_s, std::sqrt(distance * acceleration_rad_s2));
  const double acceleration = std::copysign(acceleration_rad_s2, way);
  const double ramp_s = top / acceleration_rad_s2;
  profile.Append({ramp_s, acceleration});
  profile.Append({top > 0.0 ? distance / top - ramp_s : 0.0, 0.0});
  profile.Append({ramp_s, -acceleration});
  profile.rest_rad_ = target_rad;
  return profile;
}

MotionProfile::State MotionProfile::At(double time_s) const {
  if (time_s >= end_s_) return {rest_rad_, 0.0};
  State state = from_;
  double left_s = std::max(0.0, time_s - start_s_);
  for (int i = 0; i < count_; ++i) {
    const Phase& phase = phases_[static_cast<std::size_t>(i)];
    state = After(state, std::min(left_s, phase.duration_s), phase.acceleration_rad_s2);
    left_s -= phase.duration_s;
    if (left_s <= 0.0) break;
  }
  return state;
}

}  // namespace foresight
