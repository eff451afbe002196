#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>

#include "hardware/assembly/real_head.h"
#include "hardware/emulator/emulated_devices.h"
#include "tests/hardware/tiny_head.h"
#include "tests/support/sanitized.h"
#include "tests/support/small_camera.h"

namespace foresight {

/// The default head, as far as this build can emulate it in real time: under a sanitizer with a
/// quarter of the beams, one ray each, and a sixteenth of the pixels.
inline EmulatedDevicesOptions RealTimeDevices() {
  EmulatedDevicesOptions options;
  if (!kSanitized) return options;
  options.world.lidar.footprint_side = 1;
  options.true_rig.lidar.beams = 271;
  options.true_rig.lidar.angle_step_rad *= 4.0;
  options.true_rig.camera = SmallCameraRig().camera;
  return options;
}

/// A head on the real drivers on emulated devices, over the sockets of this machine. Head and
/// devices share a clock, so stamps can be compared with the truth.
struct EmulatedHead {
  explicit EmulatedHead(const std::string& scene_file)
      : EmulatedHead(std::make_shared<const Scene>(LoadScene(scene_file).value()),
                     RealTimeDevices()) {}
  EmulatedHead(std::shared_ptr<const Scene> scene, const EmulatedDevicesOptions& options,
               const std::function<void(HeadConfig&)>& change = {}) {
    auto started = EmulatedDevices::Start(std::move(scene), options);
    if (!started) throw std::runtime_error(started.error().message);
    devices = std::move(*started);
    config.rig = devices->CalibratedRig();
    config.lidar.address = devices->lidar().address();
    config.lidar.last_step = config.rig.lidar.beams - 1;
    config.motor.host = devices->motor().address().host;
    config.motor.port = devices->motor().address().port;
    config.camera.address = devices->camera().address();
    config.camera.frame_timeout_s = 10.0;  // the image is rendered, on a busy machine
    if (change) change(config);
    head = std::make_shared<CaptureHead>(MakeDrivers(config, devices->clock()), config.rig,
                                         config.capture);
  }

  /// The state is reached before `seconds` are over.
  bool WaitFor(HeadState state, double seconds = 30.0 * kSanitizerFactor) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (head->Status().state != state) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  bool Home() const { return head->Home() && WaitFor(HeadState::kReady); }

  /// Homes and executes the plan; at its tenth line `action` is called. nullptr when the scan did
  /// not even begin.
  std::shared_ptr<const Scan> Execute(const ScanPlan& plan,
                                      const std::function<void()>& action = {}) {
    const auto assembler = std::make_shared<ScanAssembler>();
    const auto watch = std::make_shared<ScanWatch>();
    watch->action = action;
    const auto sinks =
        std::make_shared<ScanFanout>(std::vector<std::shared_ptr<ScanSink>>{assembler, watch});
    if (!Home() || !head->StartScan(plan, sinks) || !watch->WaitForEnd()) return nullptr;
    while (head->Status().state == HeadState::kSweeping ||
           head->Status().state == HeadState::kStopping)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return assembler->Snapshot();
  }

  /// The turn of the mirror that a line was measured in.
  static std::int64_t TurnOf(const LidarLine& line) {
    return std::llround(line.time_s / LidarModel().period_s);
  }

  std::unique_ptr<EmulatedDevices> devices;
  HeadConfig config;
  std::shared_ptr<SensorHead> head;  ///< last: goes first
};

}  // namespace foresight
