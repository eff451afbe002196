#include "app/common/emulation.h"

namespace foresight {

void AddEmulationOptions(CLI::App& command, CLI::Option* scene, EmulationArguments& arguments) {
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->needs(scene);
  };
  add("--rig", arguments.rig, "The head as it is (YAML); default: the built-in one");
  add("--seed", arguments.seed, "Seed of all noise and faults")->capture_default_str();
  add("--lidar", arguments.lidar, "Where the lidar listens, ADDR:PORT; default: a free port");
  add("--motor", arguments.motor, "Where the motor listens, ADDR:PORT; default: a free port");
  add("--camera", arguments.camera,
      "Where the camera listens, ADDR; default: a free address of 127.0.0.0/8");
  add("--faults", arguments.faults, "What goes wrong (YAML); default: nothing");
}

Result<std::unique_ptr<EmulatedSite>> StartEmulation(const EmulationArguments& arguments) {
  FORESIGHT_TRY(Scene scene, LoadScene(arguments.scene));
  EmulatedSiteOptions options;
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
    FORESIGHT_TRY(options.faults, LoadSiteFaults(arguments.faults, arguments.seed));
  }
  return EmulatedSite::Start(std::make_shared<const Scene>(std::move(scene)), options);
}

HeadConfig ConfigFor(EmulatedSite& site) {
  HeadConfig config;
  config.name = fmt::format("emulated: {}, seed {}", site.world()->scene().name,
                            site.world()->options().seed);
  config.simulated = true;
  config.rig = site.CalibratedRig();
  config.lidar.address = site.lidar().address();
  config.lidar.last_step = config.rig.lidar.beams - 1;
  config.motor.host = site.motor().address().host;
  config.motor.port = site.motor().address().port;
  config.camera.address = site.camera().address();
  // The emulated camera renders its pictures while the lidar's lines go on: seconds, not the
  // milliseconds that a sensor needs.
  config.camera.frame_timeout_s = config.capture.camera_timeout_s;
  config.capture.description = config.name;
  config.capture.simulated = true;
  return config;
}

}  // namespace foresight
