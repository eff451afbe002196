#include "hardware/emulator/emulated_devices.h"

#include <unistd.h>

namespace foresight {
namespace {

/// Where the plate happens to be when the head is switched on; homing has a way to go.
constexpr double kPowerOnAngle_rad = 0.2;
constexpr int kCameraAddresses = 64;

/// Several emulators on one computer need an address each.
Result<std::unique_ptr<CameraEmulator>> StartCameraAnywhere(
    const std::shared_ptr<const World>& world, const std::shared_ptr<SimulatedClock>& clock,
    const std::shared_ptr<const SimulatedShaft>& shaft, CameraEmulatorOptions options) {
  auto started = Result<std::unique_ptr<CameraEmulator>>();
  for (int i = 0; i < kCameraAddresses; ++i) {
    const int host = (getpid() + 251 * i) % 65000 + 256;
    options.address = fmt::format("127.1.{}.{}", host / 256, host % 256);
    started = CameraEmulator::Start(world, clock, shaft, options);
    if (started || started.error().code != ErrorCode::kDevice) break;
  }
  return started;
}

}  // namespace

EmulatedDevices::EmulatedDevices(std::shared_ptr<const Scene> scene,
                                 const EmulatedDevicesOptions& options)
    : world_(std::make_shared<const World>(std::move(scene), options.true_rig, options.world)),
      clock_(std::make_shared<SimulatedClock>(SimulationSpeed::kRealTime)),
      shaft_(std::make_shared<SimulatedShaft>(kPowerOnAngle_rad)) {}

Result<std::unique_ptr<EmulatedDevices>> EmulatedDevices::Start(
    std::shared_ptr<const Scene> scene, const EmulatedDevicesOptions& options) {
  FORESIGHT_CHECK(options.true_rig.Check());
  FORESIGHT_CHECK(options.world.Check());
  auto devices = std::unique_ptr<EmulatedDevices>(new EmulatedDevices(std::move(scene), options));
  const auto& [world, clock, shaft] = std::tie(devices->world_, devices->clock_, devices->shaft_);
  ScipEmulatorOptions lidar;
  lidar.address = options.lidar;
  lidar.faults = options.faults.lidar;
  FORESIGHT_TRY(devices->lidar_, ScipEmulator::Start(world, clock, shaft, lidar));
  MotorEmulatorOptions motor;
  motor.address = options.motor;
  motor.drive = options.drive;
  motor.faults = options.faults.motor;
  FORESIGHT_TRY(devices->motor_, MotorEmulator::Start(world, clock, shaft, motor));
  CameraEmulatorOptions camera;
  camera.address = options.camera;
  camera.faults = options.faults.camera;
  FORESIGHT_TRY(devices->camera_, options.camera.empty()
                                      ? StartCameraAnywhere(world, clock, shaft, camera)
                                      : CameraEmulator::Start(world, clock, shaft, camera));
  return devices;
}

LidarLine EmulatedDevices::MeasureTurn(std::int64_t turn) const {
  return world_->MeasureLine(turn, static_cast<double>(turn) * world_->true_rig().lidar.period_s,
                             [this](double time_s) { return ShaftAngle(time_s); });
}

SensorRig EmulatedDevices::CalibratedRig() const {
  SensorRig rig = world_->true_rig();
  rig.angle_correction = world_->CalibratedCorrection();
  return rig;
}

}  // namespace foresight
