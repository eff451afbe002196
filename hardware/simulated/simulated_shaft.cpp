#include "hardware/simulated/simulated_shaft.h"

#include <algorithm>

namespace foresight {
namespace {

/// Images that wait for their rendering look a few moves back, never this many.
constexpr std::size_t kRememberedMoves = 64;

}  // namespace

MotionProfile::State SimulatedShaft::At(double time_s) const {
  const std::lock_guard lock(mutex_);
  return Find(time_s);
}

MotionProfile::State SimulatedShaft::Find(double time_s) const {
  const auto later = std::find_if(history_.rbegin(), history_.rend(),
                                  [&](const auto& profile) { return profile.start_s() <= time_s; });
  return later == history_.rend() ? history_.front().At(time_s) : later->At(time_s);
}

bool SimulatedShaft::MovingAt(double time_s) const {
  const std::lock_guard lock(mutex_);
  return time_s < history_.back().end_s();
}

double SimulatedShaft::Move(double time_s, double target_rad, double speed_rad_s,
                            double acceleration_rad_s2) {
  const std::lock_guard lock(mutex_);
  Push(MotionProfile::Move(time_s, Find(time_s), target_rad, speed_rad_s, acceleration_rad_s2));
  return history_.back().end_s();
}

void SimulatedShaft::Stop(double time_s, double acceleration_rad_s2) {
  const std::lock_guard lock(mutex_);
  if (time_s >= history_.back().end_s()) return;
  Push(MotionProfile::Stop(time_s, Find(time_s), acceleration_rad_s2));
}

void SimulatedShaft::Push(const MotionProfile& profile) {
  history_.push_back(profile);
  if (history_.size() > kRememberedMoves) history_.pop_front();
}

}  // namespace foresight
