#include "app/common/emulation.h"

#include "app/common/seed_option.h"

namespace foresight {

void AddEmulationOptions(CLI::App& command, CLI::Option* scene, EmulationArguments& arguments) {
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->needs(scene);
  };
  add("--rig", arguments.rig, "The head as it is (YAML); default: the built-in one");
  AddSeedOption(command, "--seed", arguments.seed, "Seed of all noise and faults")
      ->needs(scene)
      ->capture_default_str();
  add("--lidar", arguments.lidar, "Where the lidar listens, ADDR:PORT; default: a free port");
  add("--motor", arguments.motor, "Where the motor listens, ADDR:PORT; default: a free port");
  add("--camera", arguments.camera,
      "Where the camera listens, ADDR; default: a free address of 127.0.0.0/8");
  add("--faults", arguments.faults, "What goes wrong (YAML); default: nothing");
  add("--stand-place", arguments.stand_place,
      "Where the scene's stand of boards is, from 1, 0 = away; default: its first place");
}

Result<std::unique_ptr<EmulatedDevices>> StartEmulation(const EmulationArguments& arguments) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  EmulatedDevicesOptions options;
  options.world.seed = arguments.seed;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.true_rig, LoadSensorRig(arguments.rig));
  }
  if (!arguments.lidar.empty()) {
    FORESIGHT_TRY(options.lidar, TcpAddress::Parse(arguments.lidar, 10940));
  }
  if (!arguments.motor.empty()) {
    FORESIGHT_TRY(options.motor, TcpAddress::Parse(arguments.motor, 502));
  }
  options.camera = arguments.camera;
  if (!arguments.faults.empty()) {
    FORESIGHT_TRY(options.faults, LoadDeviceFaults(arguments.faults, arguments.seed));
  }
  FORESIGHT_TRY(auto devices,
                EmulatedDevices::Start(std::make_shared<const Scene>(std::move(scene)), options));
  if (arguments.stand_place) FORESIGHT_CHECK(devices->world()->MoveStand(*arguments.stand_place));
  return devices;
}

HeadConfig ConfigFor(EmulatedDevices& devices) {
  HeadConfig config;
  config.name = fmt::format("emulated: {}, seed {}", devices.world()->scene().name,
                            devices.world()->options().seed);
  config.simulated = true;
  config.rig = devices.CalibratedRig();
  config.lidar.address = devices.lidar().address();
  config.lidar.last_step = config.rig.lidar.beams - 1;
  config.motor.host = devices.motor().address().host;
  config.motor.port = devices.motor().address().port;
  config.camera.address = devices.camera().address();
  // The emulated camera renders its images while the lidar's lines go on: seconds, not the
  // milliseconds that a sensor needs.
  config.camera.frame_timeout_s = config.capture.camera_timeout_s;
  config.capture.description = config.name;
  config.capture.simulated = true;
  return config;
}

}  // namespace foresight
