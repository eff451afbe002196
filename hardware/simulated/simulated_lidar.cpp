#include "hardware/simulated/simulated_lidar.h"

#include <cmath>

namespace foresight {

SimulatedLidar::SimulatedLidar(std::shared_ptr<const World> world,
                               std::shared_ptr<SimulatedClock> clock,
                               std::shared_ptr<const SimulatedShaft> shaft)
    : world_(std::move(world)), clock_(std::move(clock)), shaft_(std::move(shaft)) {}

Status SimulatedLidar::Connect() {
  connected_ = true;
  return {};
}

void SimulatedLidar::Stop() {
  running_ = false;
}

Status SimulatedLidar::Start() {
  running_ = true;
  next_turn_ =
      static_cast<std::int64_t>(std::ceil(clock_->Now() / world_->true_rig().lidar.period_s));
  return {};
}

Result<std::optional<LidarLine>> SimulatedLidar::WaitForLine(std::chrono::milliseconds timeout) {
  if (!running_) return Fail(ErrorCode::kState, "{}: is not measuring", Describe());
  const LidarModel& model = world_->true_rig().lidar;
  const double stamp_s = static_cast<double>(next_turn_) * model.period_s;
  const double ready_s = stamp_s + model.BeamTime(model.beams);
  const double give_up_s = clock_->Now() + std::chrono::duration<double>(timeout).count();
  if (ready_s > give_up_s) {
    clock_->WaitUntil(give_up_s);
    return std::nullopt;
  }
  clock_->WaitUntil(ready_s);
  ++lines_;
  return world_->MeasureLine(next_turn_++, stamp_s,
                             [this](double time_s) { return shaft_->At(time_s).angle_rad; });
}

LidarHealth SimulatedLidar::Health() const {
  LidarHealth health;
  health.connected = connected_;
  health.streaming = running_;
  health.line_rate_hz = running_ ? 1.0 / world_->true_rig().lidar.period_s : 0.0;
  health.lines = lines_;
  return health;
}

}  // namespace foresight
