#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "core/simulation/world.h"
#include "hardware/api/camera.h"
#include "hardware/simulated/simulated_clock.h"
#include "hardware/simulated/simulated_shaft.h"

namespace foresight {

/// A global-shutter camera. In real time a thread of its own renders, so that the lidar's lines do
/// not wait for it; as fast as possible, an image is rendered when it is waited for.
class SimulatedCamera final : public Camera {
 public:
  /// From the end of the exposure to the frame.
  static constexpr double kReadout_s = 0.03;

  SimulatedCamera(std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
                  std::shared_ptr<const SimulatedShaft> shaft);

  std::string Describe() const override { return "simulated camera"; }
  Status Connect() override;
  Status Configure(const CameraSettings& settings) override;
  Result<std::int64_t> Trigger() override;
  Result<std::optional<CameraFrame>> WaitForFrame(std::chrono::milliseconds timeout) override;
  CameraHealth Health() const override;

 private:
  struct Exposure {
    std::int64_t seq = 0;
    double middle_s = 0.0;
    CameraSettings settings;

    double ReadyAt() const { return middle_s + 0.5 * settings.exposure_s + kReadout_s; }
  };

  void Work(const std::stop_token& stop);
  CameraFrame Render(const Exposure& exposure, const RunContext& context) const;

  std::shared_ptr<const World> world_;
  std::shared_ptr<SimulatedClock> clock_;
  std::shared_ptr<const SimulatedShaft> shaft_;
  CameraSettings settings_;
  std::int64_t next_seq_ = 0;

  mutable std::mutex mutex_;  ///< guards the queues and the health
  std::deque<Exposure> exposed_;
  std::deque<CameraFrame> finished_;
  CameraHealth health_;
  std::condition_variable_any wake_;
  std::condition_variable_any arrived_;
  std::jthread thread_;  ///< only in real time; last: it uses everything above
};

}  // namespace foresight
