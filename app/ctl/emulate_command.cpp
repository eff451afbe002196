#include <poll.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

#include "app/common/emulation.h"
#include "app/ctl/command.h"

namespace foresight {
namespace {

struct EmulateArguments {
  EmulationArguments emulation;
  std::string head_config;
  double seconds = 0.0;  ///< 0: until somebody stops it
  bool commands = false;
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

/// What comes on standard input, line by line, without waiting for it.
class CommandInput {
 public:
  std::optional<std::string> Next() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    while (open_ && poll(&input, 1, 0) > 0) {
      char bytes[256];
      const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
      open_ = count > 0;
      if (open_) text_.append(bytes, static_cast<std::size_t>(count));
    }
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    const std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return line;
  }

 private:
  bool open_ = true;
  std::string text_;
};

/// "place 3" moves the stand; what became of it goes to standard output.
void Obey(const std::string& line, const World& world) {
  constexpr std::string_view kPlace = "place ";
  int place = -1;
  const bool is_place =
      line.starts_with(kPlace) &&
      std::from_chars(line.data() + kPlace.size(), line.data() + line.size(), place).ptr ==
          line.data() + line.size();
  const Status moved =
      is_place
          ? world.MoveStand(place)
          : Status(Fail(ErrorCode::kInvalidInput, "'{}' is no command; there is: place N", line));
  PrintLine(moved ? fmt::format("place {}", place) : "error: " + moved.error().message);
  (void)CheckOutput();  // who reads it waits for it
}

void WaitForTheEnd(EmulatedDevices& devices, const EmulateArguments& arguments,
                   const RunContext& context) {
  const double seconds = arguments.seconds;
  CommandInput input;
  const auto start = std::chrono::steady_clock::now();
  const auto over = [&] {
    return seconds > 0.0 &&
           std::chrono::steady_clock::now() - start > std::chrono::duration<double>(seconds);
  };
  while (!context.Cancelled() && !over()) {
    while (const auto line = arguments.commands ? input.Next() : std::nullopt)
      Obey(*line, *devices.world());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

Result<ExitCode> Emulate(const EmulateArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const auto devices, StartEmulation(arguments.emulation));
  if (!arguments.head_config.empty())
    FORESIGHT_CHECK(SaveHeadConfig(ConfigFor(*devices), arguments.head_config));
  PrintAddresses(*devices, arguments);
  FORESIGHT_CHECK(CheckOutput());  // nobody would know where they are
  WaitForTheEnd(*devices, arguments, context);
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
  command->add_flag("--commands", arguments->commands,
                    "Read commands from standard input: \"place N\" moves the scene's stand");
  command->add_flag("--json", arguments->json, "Print the addresses as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Emulate(*arguments, context); };
  });
}

}  // namespace foresight
