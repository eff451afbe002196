#include "hardware/head/motor_moves.h"

#include <fmt/format.h>

#include "core/sensor/scan_plan.h"

namespace foresight {
namespace {

constexpr std::chrono::microseconds kPoll{5000};

}  // namespace

MotorMoves::Step MotorMoves::Start(double angle_rad, double speed_rad_s) {
  encoder_.ExpectAnyMotion(speed_rad_s);
  if (const Status moving = devices_.motor->StartMove(angle_rad, speed_rad_s); !moving)
    return DeviceFailed(moving.error().message);
  return std::nullopt;
}

MotorMoves::Step MotorMoves::WaitForStandstill(double timeout_s, const Look& look) {
  const double deadline_s = devices_.clock->Now() + timeout_s;
  for (;;) {
    if (Step end = look()) return end;
    const Result<bool> moving = devices_.motor->Moving();
    if (!moving) return DeviceFailed(moving.error().message);
    if (!*moving) return std::nullopt;
    if (devices_.clock->Now() > deadline_s)
      return DeviceFailed(fmt::format("{}: did not come to rest within {:.0f} s",
                                      devices_.motor->Describe(), timeout_s));
    devices_.clock->Sleep(kPoll);
  }
}

MotorMoves::Step MotorMoves::StandFor(double seconds, const Look& look) {
  const double end_s = devices_.clock->Now() + seconds;
  while (devices_.clock->Now() < end_s) {
    if (Step end = look()) return end;
    devices_.clock->Sleep(kPoll);
  }
  return std::nullopt;
}

double MotorMoves::TravelTimeout() const {
  const double longest_way = ScanPlan::kMaxAngle_rad - ScanPlan::kMinAngle_rad;
  return kStandstillTimeout_s + 2.0 * longest_way / options_.travel_speed_rad_s;
}

MotorMoves::Step MotorMoves::ReadPosition(MotorSample* position) {
  const Result<MotorSample> now = devices_.motor->Position();
  if (!now) return DeviceFailed(now.error().message);
  *position = *now;
  return std::nullopt;
}

MotorMoves::Step MotorMoves::TakeTrack(
    const std::function<void(const std::vector<MotorSample>&)>& keep) {
  std::vector<MotorSample> samples = devices_.motor->TakeTrack();
  std::optional<std::string> impossible;
  for (std::size_t i = 0; i < samples.size() && !impossible; ++i)
    if ((impossible = encoder_.Check(samples[i]))) samples.resize(i);
  if (!samples.empty()) keep(samples);
  if (!impossible) return std::nullopt;
  return DeviceFailed(fmt::format("{}: {}", devices_.motor->Describe(), *impossible));
}

}  // namespace foresight
