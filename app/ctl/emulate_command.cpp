#include <chrono>
#include <memory>
#include <thread>

#include "app/common/emulation.h"
#include "app/ctl/command.h"

namespace foresight {
namespace {

struct EmulateArguments {
  EmulationArguments emulation;
  std::string head_config;
  double seconds = 0.0;  ///< 0: until somebody stops it
  bool json = false;
};

void PrintAddresses(EmulatedDevices& devices, const EmulateArguments& arguments) {
  const std::string lidar = devices.lidar().address().ToText();
  const std::string motor = devices.motor().address().ToText();
  const std::string& camera = devices.camera().address();
  if (arguments.json)
    PrintJson({{"lidar", lidar},
               {"motor", motor},
               {"camera", camera},
               {"head_config", arguments.head_config}});
  else
    PrintLine(fmt::format("lidar {}  motor {}  camera {}", lidar, motor, camera));
}

void WaitForTheEnd(double seconds, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const auto over = [&] {
    return seconds > 0.0 &&
           std::chrono::steady_clock::now() - start > std::chrono::duration<double>(seconds);
  };
  while (!context.Cancelled() && !over())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

Result<ExitCode> Emulate(const EmulateArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const auto devices, StartEmulation(arguments.emulation));
  if (!arguments.head_config.empty())
    FORESIGHT_CHECK(SaveHeadConfig(ConfigFor(*devices), arguments.head_config));
  PrintAddresses(*devices, arguments);
  FORESIGHT_CHECK(CheckOutput());  // nobody would know where they are
  WaitForTheEnd(arguments.seconds, context);
  return ExitCode::kDone;
}

}  // namespace

void AddEmulateCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EmulateArguments>();
  CLI::App* command = app.add_subcommand(
      "emulate", "Play lidar, motor and camera of a head on this computer's network");
  CLI::Option* scene =
      command->add_option("scene", arguments->emulation.scene, "Scene file (YAML)")->required();
  AddEmulationOptions(*command, scene, arguments->emulation);
  command->add_option("--head-config", arguments->head_config,
                      "Write a head's configuration that points at the emulated devices");
  command->add_option("--seconds", arguments->seconds, "End after so long; default: when stopped")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", arguments->json, "Print the addresses as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Emulate(*arguments, context); };
  });
}

}  // namespace foresight
