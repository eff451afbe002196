#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "hardware/emulator/camera_emulator.h"
#include "hardware/gige/gige_camera.h"

namespace foresight {

/// A quarter of the real camera before a wall with a pattern; an image takes some ten milliseconds
/// to render.
inline std::shared_ptr<const World> GigeWorld() {
  SensorRig rig = DefaultSensorRig();
  rig.camera = PinholeCamera(322, 241, 150.0, 160.5, 120.0);
  auto scene = std::make_shared<Scene>();
  scene->name = "wall";
  SceneMesh wall;
  wall.vertices = {{2, -5, -5}, {2, 5, -5}, {2, 5, 5}, {2, -5, 5}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.material.color = {0.8, 0.3, 0.1};
  wall.material.color2 = {0.1, 0.4, 0.7};
  wall.material.pattern = Material::Pattern::kChecker;
  wall.material.pattern_size_m = 0.3;
  scene->meshes = {wall};
  scene->lights = {Light()};
  WorldOptions options;
  options.camera.samples_side = 1;
  return std::make_shared<const World>(scene, rig, options);
}

/// GigE Vision's port cannot be chosen, so every test program takes an address of its own: several
/// run at a time.
inline std::string GigeAddress(int camera = 0) {
  const int pid = ::getpid();
  return fmt::format("127.{}.{}.{}", 10 + 100 * camera + ((pid >> 14) & 0x3F),
                     1 + ((pid >> 7) & 0x7F), 1 + (pid & 0x7F));
}

/// An emulated camera on a shaft, and a driver for it over loopback.
struct GigeBench {
  /// A condition has so long to come true. Far more than it takes: this machine may be busy.
  static constexpr double kDeadline_s = 20.0;

  explicit GigeBench(const CameraFaults& faults = {},
                     const std::function<void(GigeCameraOptions&)>& change = {}) {
    CameraEmulatorOptions emulated;
    emulated.address = GigeAddress();
    emulated.faults = faults;
    auto started = CameraEmulator::Start(world, clock, shaft, emulated);
    if (!started) throw std::runtime_error(started.error().message);
    emulator = std::move(*started);
    options.address = emulator->address();
    options.format = GigeCameraOptions::Format::kRGB8;
    options.connect_timeout_s = kDeadline_s;
    options.frame_timeout_s = kDeadline_s;  // rendering takes its time on a busy machine
    if (change) change(options);
    camera = std::make_unique<GigeCamera>(options, clock);
  }

  static bool WaitFor(const std::function<bool()>& condition, double seconds = kDeadline_s) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  /// One image, from its trigger; or why not.
  Result<CameraFrame> Take() const {
    FORESIGHT_CHECK(camera->Trigger());
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kDeadline_s);
    while (std::chrono::steady_clock::now() < end) {
      FORESIGHT_TRY(auto frame, camera->WaitForFrame(std::chrono::milliseconds(100)));
      if (frame) return std::move(*frame);
    }
    return Fail(ErrorCode::kDevice, "no image and no error");
  }

  /// What a camera in this process would have taken then.
  ColorImage Truth(const CameraEmulator::Taken& taken) const {
    return world
        ->CaptureImage(
            taken.seq, taken.middle_s, taken.exposure_s, taken.gain_db,
            [this](double time_s) { return shaft->At(time_s).angle_rad; }, RunContext())
        .image;
  }

  std::shared_ptr<const World> world = GigeWorld();
  std::shared_ptr<SimulatedClock> clock =
      std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime);
  std::shared_ptr<SimulatedShaft> shaft = std::make_shared<SimulatedShaft>(0.1);
  GigeCameraOptions options;
  std::unique_ptr<CameraEmulator> emulator;
  std::unique_ptr<GigeCamera> camera;  ///< last: goes first
};

}  // namespace foresight
