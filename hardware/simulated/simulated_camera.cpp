#include "hardware/simulated/simulated_camera.h"

#include <algorithm>

#include "core/base/log.h"

namespace foresight {

SimulatedCamera::SimulatedCamera(std::shared_ptr<const World> world,
                                 std::shared_ptr<SimulatedClock> clock,
                                 std::shared_ptr<const SimulatedShaft> shaft)
    : world_(std::move(world)), clock_(std::move(clock)), shaft_(std::move(shaft)) {
  if (clock_->speed() == SimulationSpeed::kRealTime)
    thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

/// Images of an earlier connection are of no use to the next one.
Status SimulatedCamera::Connect() {
  const std::lock_guard lock(mutex_);
  exposed_.clear();
  finished_.clear();
  health_.connected = true;
  return {};
}

Status SimulatedCamera::Configure(const CameraSettings& settings) {
  settings_ = settings;
  return {};
}

Result<std::int64_t> SimulatedCamera::Trigger() {
  const Exposure exposure{next_seq_++, clock_->Now() + 0.5 * settings_.exposure_s, settings_};
  const std::lock_guard lock(mutex_);
  exposed_.push_back(exposure);
  wake_.notify_all();
  return exposure.seq;
}

Result<std::optional<CameraFrame>> SimulatedCamera::WaitForFrame(
    std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (clock_->speed() == SimulationSpeed::kRealTime) {
    arrived_.wait_for(lock, timeout, [this] { return !finished_.empty(); });
    if (finished_.empty()) return std::nullopt;
    CameraFrame frame = std::move(finished_.front());
    finished_.pop_front();
    ++health_.frames;
    return frame;
  }
  const double give_up_s = clock_->Now() + std::chrono::duration<double>(timeout).count();
  if (exposed_.empty() || exposed_.front().ReadyAt() > give_up_s) {
    clock_->WaitUntil(give_up_s);
    return std::nullopt;
  }
  const Exposure exposure = exposed_.front();
  exposed_.pop_front();
  ++health_.frames;
  lock.unlock();
  clock_->WaitUntil(exposure.ReadyAt());
  return Render(exposure, RunContext());
}

CameraHealth SimulatedCamera::Health() const {
  const std::lock_guard lock(mutex_);
  return health_;
}

CameraFrame SimulatedCamera::Render(const Exposure& exposure, const RunContext& context) const {
  CameraFrame frame = world_->CaptureImage(
      exposure.seq, exposure.middle_s, exposure.settings.exposure_s, exposure.settings.gain_db,
      [this](double time_s) { return shaft_->At(time_s).angle_rad; }, context);
  frame.motor_angle_rad = 0.0;  // a camera does not know it
  return frame;
}

void SimulatedCamera::Work(const std::stop_token& stop) {
  RunContext context;
  context.stop = stop;
  for (;;) {
    Exposure exposure;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return !exposed_.empty(); })) return;
      exposure = exposed_.front();
      exposed_.pop_front();
    }
    clock_->WaitUntil(exposure.ReadyAt());
    try {
      CameraFrame frame = Render(exposure, context);
      if (stop.stop_requested()) return;
      const std::lock_guard lock(mutex_);
      finished_.push_back(std::move(frame));
      arrived_.notify_all();
    } catch (const std::exception& error) {
      // The frame stays out, and who waits for it says so.
      LogError("{}: {}", Describe(), error.what());
      const std::lock_guard lock(mutex_);
      ++health_.lost;
      health_.last_error = error.what();
    }
  }
}

}  // namespace foresight
