#include "hardware/simulated/simulated_head.h"

#include "hardware/head/capture_head.h"
#include "hardware/simulated/simulated_camera.h"
#include "hardware/simulated/simulated_lidar.h"
#include "hardware/simulated/simulated_motor.h"

namespace foresight {

Result<std::unique_ptr<SensorHead>> MakeSimulatedHead(std::shared_ptr<const Scene> scene,
                                                      const SimulatedHeadOptions& options) {
  FORESIGHT_CHECK(options.true_rig.Check());
  return MakeSimulatedHead(
      std::make_shared<const World>(std::move(scene), options.true_rig, options.world), options);
}

Result<std::unique_ptr<SensorHead>> MakeSimulatedHead(std::shared_ptr<const World> world,
                                                      const SimulatedHeadOptions& options) {
  FORESIGHT_CHECK(options.believed_rig.Check());
  const auto clock = std::make_shared<SimulatedClock>(options.speed);
  const auto shaft = std::make_shared<SimulatedShaft>(SimulatedMotor::kPowerOnAngle_rad);
  HeadDevices devices;
  devices.lidar = std::make_unique<SimulatedLidar>(world, clock, shaft);
  devices.camera = std::make_unique<SimulatedCamera>(world, clock, shaft);
  devices.motor = std::make_unique<SimulatedMotor>(world, clock, shaft);
  devices.clock = clock;
  CaptureOptions capture;
  capture.description =
      fmt::format("simulated: {}, seed {}", world->scene().name, world->options().seed);
  capture.simulated = true;
  capture.acceleration_rad_s2 = SimulatedMotor::kAcceleration_rad_s2;
  capture.operator_timeout_s =
      options.speed == SimulationSpeed::kRealTime ? options.operator_timeout_s : 0.0;
  return std::make_unique<CaptureHead>(std::move(devices), options.believed_rig,
                                       std::move(capture));
}

Result<std::unique_ptr<SensorHead>> MakeSimulatedHead(const std::filesystem::path& scene_file,
                                                      const SimulatedHeadOptions& options) {
  FORESIGHT_TRY(Scene scene, LoadScene(scene_file));
  return MakeSimulatedHead(std::make_shared<const Scene>(std::move(scene)), options);
}

}  // namespace foresight
