#include <chrono>
#include <memory>

#include "app/common/emulation.h"
#include "app/ctl/command.h"
#include "hardware/api/health_watch.h"
#include "hardware/assembly/real_head.h"
#include "hardware/head/real_time_clock.h"

namespace foresight {
namespace {

constexpr double kReportPeriod_s = 1.0;

struct HealthArguments {
  std::string head_config;
  EmulationArguments emulation;
  double seconds = 0.0;  ///< 0: until somebody stops it
  bool json = false;
};

/// A head's devices without a head: they are connected and the lidar measures, but nothing moves.
class DeviceBench {
 public:
  explicit DeviceBench(const HeadConfig& config)
      : devices_(MakeDrivers(config, std::make_shared<RealTimeClock>())) {}

  /// Fails when not a single device can be reached; says on stderr which ones cannot.
  Status Connect() {
    const Status lidar = devices_.lidar->Connect();
    const Status camera = devices_.camera->Connect();
    const Status motor = devices_.motor->Connect();
    if (lidar) FORESIGHT_CHECK(devices_.lidar->Start());
    if (!lidar && !camera && !motor)
      return Fail(ErrorCode::kDevice, "{}; {}; {}", lidar.error().message, camera.error().message,
                  motor.error().message);
    for (const Status* status : {&lidar, &camera, &motor})
      if (!*status) PrintNoteLine(status->error().message);
    return {};
  }

  double Now() const { return devices_.clock->Now(); }
  HeadHealth Health() const { return ReadHealth(devices_); }

  /// Lets the devices work until `time_s`, or until cancelled. Nobody wants what they measure, but
  /// it must not pile up.
  void Work(double time_s, const RunContext& context) {
    constexpr std::chrono::milliseconds kWait{50};
    while (Now() < time_s && !context.Cancelled()) {
      if (!devices_.lidar->WaitForLine(kWait)) devices_.clock->Sleep(kWait);
      devices_.motor->TakeTrack();
    }
  }

 private:
  HeadDevices devices_;
};

std::string Row(const char* device, const DeviceDiagnosis& diagnosis, const std::string& numbers) {
  if (diagnosis.condition == DeviceCondition::kMissing)
    return fmt::format("{} missing: {}", device, diagnosis.problem);
  return fmt::format("{} {}: {}{}", device, ToString(diagnosis.condition), numbers,
                     diagnosis.problem.empty() ? "" : " (" + diagnosis.problem + ")");
}

std::string AsText(const HeadHealth& health, const HeadDiagnosis& diagnosis) {
  return fmt::format("{} | {} | {}", Row("lidar", diagnosis.lidar, Describe(health.lidar)),
                     Row("camera", diagnosis.camera, Describe(health.camera)),
                     Row("motor", diagnosis.motor, Describe(health.motor)));
}

std::string AsJson(double time_s, const HeadHealth& health, const HeadDiagnosis& diagnosis) {
  nlohmann::ordered_json line{{"time_s", time_s}, {"condition", ToString(diagnosis.Worst())}};
  line.update(nlohmann::ordered_json::parse(ToJson(health)));
  const auto add = [&](const char* device, const DeviceDiagnosis& found) {
    line[device]["condition"] = ToString(found.condition);
    line[device]["problem"] = found.problem;
  };
  add("lidar", diagnosis.lidar);
  add("camera", diagnosis.camera);
  add("motor", diagnosis.motor);
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<ExitCode> Report(DeviceBench& bench, const HealthArguments& arguments,
                        const RunContext& context) {
  FORESIGHT_CHECK(bench.Connect());
  const double start_s = bench.Now();
  HealthWatch watch;
  DeviceCondition worst = DeviceCondition::kWell;
  for (int i = 1; arguments.seconds <= 0.0 || i * kReportPeriod_s <= arguments.seconds; ++i) {
    bench.Work(start_s + i * kReportPeriod_s, context);
    if (context.Cancelled()) break;
    const double time_s = bench.Now() - start_s;
    const HeadHealth health = bench.Health();
    const HeadDiagnosis diagnosis = watch.Update(time_s, health);
    worst = std::max(worst, diagnosis.Worst());
    PrintLine(arguments.json ? AsJson(time_s, health, diagnosis) : AsText(health, diagnosis));
    FORESIGHT_CHECK(CheckOutput());  // nobody reads on
  }
  return worst == DeviceCondition::kWell ? ExitCode::kDone : ExitCode::kNegative;
}

Result<ExitCode> ShowHealth(const HealthArguments& arguments, const RunContext& context) {
  std::unique_ptr<EmulatedDevices> emulated;
  HeadConfig config;
  if (arguments.emulation.scene.empty()) {
    FORESIGHT_TRY(config, LoadHeadConfig(arguments.head_config));
  } else {
    FORESIGHT_TRY(emulated, StartEmulation(arguments.emulation));
    config = ConfigFor(*emulated);
  }
  DeviceBench bench(config);
  return Report(bench, arguments, context);
}

}  // namespace

void AddHealthCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<HealthArguments>();
  CLI::App* command = app.add_subcommand(
      "health", "Say once a second how a head's devices do; nothing moves, the lidar measures");
  CLI::Option* config = command->add_option("--head-config", arguments->head_config,
                                            "The head and its devices (YAML)");
  CLI::Option* emulate = command->add_option(
      "--emulate", arguments->emulation.scene,
      "Scene file (YAML): emulate the devices in this process, on real sockets");
  config->excludes(emulate);
  AddEmulationOptions(*command, emulate, arguments->emulation);
  command->add_option("--seconds", arguments->seconds, "End after so long; default: when stopped")
      ->check(CLI::Range(1.0, 1e9));
  command->add_flag("--json", arguments->json, "One JSON object a second");
  command->callback([&invocation, arguments] {
    if (arguments->head_config.empty() && arguments->emulation.scene.empty())
      throw CLI::RequiredError("--head-config or --emulate");
    invocation = [arguments](const RunContext& context) { return ShowHealth(*arguments, context); };
  });
}

}  // namespace foresight
