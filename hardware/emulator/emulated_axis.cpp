#include "hardware/emulator/emulated_axis.h"

#include <cmath>

namespace foresight {
namespace {

/// A stop or a hand on the plate brakes this hard: at rest within a cycle.
constexpr double kImpact_rad_s2 = 2000.0;

}  // namespace

EmulatedAxis::EmulatedAxis(std::shared_ptr<SimulatedShaft> shaft, double end_stop_rad,
                           double time_s)
    : shaft_(std::move(shaft)), end_stop_rad_(end_stop_rad), demand_(AngleAt(time_s)) {}

bool EmulatedAxis::Free(double time_s, double target_rad) const {
  const double angle_rad = AngleAt(time_s);
  const bool outwards = std::abs(angle_rad) >= end_stop_rad_ && target_rad * angle_rad > 0.0 &&
                        std::abs(target_rad) > std::abs(angle_rad);
  return !blocked_ && !outwards;
}

void EmulatedAxis::Hold(double time_s) {
  shaft_->Stop(time_s, kImpact_rad_s2);
}

void EmulatedAxis::Move(double time_s, double target_rad, double speed_rad_s,
                        double acceleration_rad_s2) {
  demand_ =
      MotionProfile::Move(time_s, demand_.At(time_s), target_rad, speed_rad_s, acceleration_rad_s2);
  if (Free(time_s, target_rad)) shaft_->Move(time_s, target_rad, speed_rad_s, acceleration_rad_s2);
}

void EmulatedAxis::Stop(double time_s, double acceleration_rad_s2) {
  demand_ = MotionProfile::Stop(time_s, demand_.At(time_s), acceleration_rad_s2);
  shaft_->Stop(time_s, acceleration_rad_s2);
}

void EmulatedAxis::Update(double time_s) {
  const MotionProfile::State state = shaft_->At(time_s);
  if (std::abs(state.angle_rad) >= end_stop_rad_ && state.speed_rad_s * state.angle_rad > 0.0)
    Hold(time_s);
}

void EmulatedAxis::Block(double time_s) {
  blocked_ = true;
  Hold(time_s);
}

void EmulatedAxis::Release(double time_s) {
  blocked_ = false;
  AcceptPosition(time_s);
}

double EmulatedAxis::FollowingError(double time_s) const {
  return std::abs(demand_.At(time_s).angle_rad - AngleAt(time_s));
}

void EmulatedAxis::AcceptPosition(double time_s) {
  demand_ = MotionProfile(AngleAt(time_s));
}

}  // namespace foresight
