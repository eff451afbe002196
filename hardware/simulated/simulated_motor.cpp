#include "hardware/simulated/simulated_motor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kNever_s = std::numeric_limits<double>::infinity();
constexpr double kHomingSpeed_rad_s = RadiansFromDegrees(20.0);
/// The drive's memory of the encoder; who does not fetch for longer loses the oldest samples.
constexpr double kRemembered_s = 10.0;

}  // namespace

SimulatedMotor::SimulatedMotor(std::shared_ptr<const World> world,
                               std::shared_ptr<SimulatedClock> clock,
                               std::shared_ptr<SimulatedShaft> shaft)
    : world_(std::move(world)),
      clock_(std::move(clock)),
      shaft_(std::move(shaft)),
      homed_at_s_(kNever_s) {}

SimulatedMotor::~SimulatedMotor() {
  shaft_->Stop(clock_->Now(), kAcceleration_rad_s2);
}

Status SimulatedMotor::Connect() {
  connected_ = true;
  return {};
}

Status SimulatedMotor::StartHoming() {
  if (!connected_) return Fail(ErrorCode::kState, "{}: is not connected", Describe());
  homed_at_s_ = shaft_->Move(clock_->Now(), 0.0, kHomingSpeed_rad_s, kAcceleration_rad_s2);
  return {};
}

bool SimulatedMotor::Homed() const {
  return clock_->Now() >= homed_at_s_;
}

Status SimulatedMotor::StartMove(double angle_rad, double speed_rad_s) {
  if (!Homed())
    return Fail(ErrorCode::kState, "{}: has no zero reference: home it first", Describe());
  if (!(std::abs(angle_rad) <= kEndStop_rad) || !(speed_rad_s > 0.0))
    return Fail(ErrorCode::kDevice, "{}: refused a move to {:.1f} deg at {:.1f} deg/s", Describe(),
                DegreesFromRadians(angle_rad), DegreesFromRadians(speed_rad_s));
  shaft_->Move(clock_->Now(), angle_rad, speed_rad_s, kAcceleration_rad_s2);
  return {};
}

Result<bool> SimulatedMotor::Moving() {
  return shaft_->MovingAt(clock_->Now());
}

double SimulatedMotor::Report(double time_s) const {
  const double zero_rad = time_s >= homed_at_s_ ? 0.0 : kPowerOnAngle_rad;
  return world_->EncoderAngle(shaft_->At(time_s).angle_rad - zero_rad);
}

Result<MotorSample> SimulatedMotor::Position() {
  if (!connected_) return Fail(ErrorCode::kDevice, "{}: is not connected", Describe());
  const double now_s = clock_->Now();
  return MotorSample{now_s, Report(now_s)};
}

std::vector<MotorSample> SimulatedMotor::TakeTrack() {
  const double now_s = clock_->Now();
  const auto last = static_cast<std::int64_t>(std::floor(now_s * kSampleRate_hz));
  const auto oldest = static_cast<std::int64_t>((now_s - kRemembered_s) * kSampleRate_hz);
  std::vector<MotorSample> samples;
  for (next_sample_ = std::max(next_sample_, oldest); next_sample_ <= last; ++next_sample_) {
    const double time_s = static_cast<double>(next_sample_) / kSampleRate_hz;
    samples.push_back({time_s, Report(time_s)});
  }
  return samples;
}

void SimulatedMotor::QuickStop() {
  const double now_s = clock_->Now();
  if (now_s < homed_at_s_) homed_at_s_ = kNever_s;
  shaft_->Stop(now_s, kAcceleration_rad_s2);
}

MotorHealth SimulatedMotor::Health() const {
  MotorHealth health;
  health.connected = connected_;
  health.poll_rate_hz = connected_ ? kSampleRate_hz : 0.0;
  return health;
}

}  // namespace foresight
