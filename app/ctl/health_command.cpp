#include <chrono>
#include <memory>
#include <optional>

#include "app/common/connect_head.h"
#include "app/common/emulation.h"
#include "app/ctl/command.h"
#include "hardware/api/health_watch.h"
#include "hardware/assembly/real_head.h"
#include "hardware/head/real_time_clock.h"
#include "hardware/link/client/remote_head.h"

namespace foresight {
namespace {

constexpr double kReportPeriod_s = 1.0;

struct HealthArguments {
  std::string head_config;
  EmulationArguments emulation;
  LinkArguments link;    ///< to a head elsewhere
  double seconds = 0.0;  ///< 0: until somebody stops it
  bool json = false;
};

/// What is reported.
struct HealthReport {
  HeadHealth devices;
  std::optional<LinkHealth> link;  ///< of a head elsewhere
};

/// Where devices are.
class HealthSource {
 public:
  virtual ~HealthSource() = default;
  virtual Status Connect() = 0;
  virtual double Now() const = 0;
  virtual HealthReport Report() const = 0;
  /// Until `time_s`, or until cancelled.
  virtual void Work(double time_s, const RunContext& context) = 0;
};

/// A head's devices without a head: they are connected and the lidar measures, but nothing moves.
class DeviceBench final : public HealthSource {
 public:
  explicit DeviceBench(const HeadConfig& config)
      : devices_(MakeDrivers(config, std::make_shared<RealTimeClock>())) {}

  /// Fails when not a single device can be reached; says on stderr which ones cannot.
  Status Connect() override {
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

  double Now() const override { return devices_.clock->Now(); }
  HealthReport Report() const override { return {ReadHealth(devices_), {}}; }

  /// Nobody wants what the devices measure, but it must not pile up.
  void Work(double time_s, const RunContext& context) override {
    constexpr std::chrono::milliseconds kWait{50};
    while (Now() < time_s && !context.Cancelled()) {
      if (!devices_.lidar->WaitForLine(kWait)) devices_.clock->Sleep(kWait);
      devices_.motor->TakeTrack();
    }
  }

 private:
  HeadDevices devices_;
};

/// What a head elsewhere says of its devices. They are as that head keeps them: this changes
/// nothing.
class HeadElsewhere final : public HealthSource {
 public:
  explicit HeadElsewhere(const LinkArguments& link) : link_(link) {}

  Status Connect() override {
    FORESIGHT_TRY(head_, LookAtHead(link_));
    return {};
  }
  double Now() const override { return clock_.Now(); }
  HealthReport Report() const override { return {head_->Status().health, head_->Health()}; }
  void Work(double time_s, const RunContext& context) override {
    constexpr std::chrono::milliseconds kLook{50};
    while (Now() < time_s && !context.Cancelled()) clock_.Sleep(kLook);
  }

 private:
  const LinkArguments link_;
  RealTimeClock clock_;
  std::shared_ptr<RemoteHead> head_;
};

/// Of devices whose head says nothing, nothing is known.
DeviceCondition WorstOf(const HealthReport& report, const HeadDiagnosis& diagnosis) {
  const bool lost = report.link && !report.link->connected;
  return lost ? DeviceCondition::kMissing : diagnosis.Worst();
}

std::string Row(const char* device, const DeviceDiagnosis& diagnosis, const std::string& numbers) {
  if (diagnosis.condition == DeviceCondition::kMissing)
    return fmt::format("{} missing: {}", device, diagnosis.problem);
  return fmt::format("{} {}: {}{}", device, ToString(diagnosis.condition), numbers,
                     diagnosis.problem.empty() ? "" : " (" + diagnosis.problem + ")");
}

std::string AsText(const LinkHealth& link) {
  if (link.connected)
    return fmt::format(" | link well: round trip {:.0f} ms", 1e3 * link.round_trip_s);
  return fmt::format(" | link missing: no word for {:.0f} s ({})", link.age_s, link.trouble);
}

std::string AsText(const HealthReport& report, const HeadDiagnosis& diagnosis) {
  const HeadHealth& health = report.devices;
  return fmt::format("{} | {} | {}{}", Row("lidar", diagnosis.lidar, Describe(health.lidar)),
                     Row("camera", diagnosis.camera, Describe(health.camera)),
                     Row("motor", diagnosis.motor, Describe(health.motor)),
                     report.link ? AsText(*report.link) : "");
}

std::string AsJson(double time_s, const HealthReport& report, const HeadDiagnosis& diagnosis) {
  nlohmann::ordered_json line{{"time_s", time_s},
                              {"condition", ToString(WorstOf(report, diagnosis))}};
  line.update(nlohmann::ordered_json::parse(ToJson(report.devices)));
  if (report.link)
    line["link"] = {{"connected", report.link->connected},
                    {"age_s", report.link->age_s},
                    {"round_trip_s", report.link->round_trip_s},
                    {"problem", report.link->trouble}};
  const auto add = [&](const char* device, const DeviceDiagnosis& found) {
    line[device]["condition"] = ToString(found.condition);
    line[device]["problem"] = found.problem;
  };
  add("lidar", diagnosis.lidar);
  add("camera", diagnosis.camera);
  add("motor", diagnosis.motor);
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Result<ExitCode> Report(HealthSource& bench, const HealthArguments& arguments,
                        const RunContext& context) {
  FORESIGHT_CHECK(bench.Connect());
  const double start_s = bench.Now();
  HealthWatch watch;
  DeviceCondition worst = DeviceCondition::kWell;
  for (int i = 1; arguments.seconds <= 0.0 || i * kReportPeriod_s <= arguments.seconds; ++i) {
    bench.Work(start_s + i * kReportPeriod_s, context);
    if (context.Cancelled()) break;
    const double time_s = bench.Now() - start_s;
    const HealthReport report = bench.Report();
    const HeadDiagnosis diagnosis = watch.Update(time_s, report.devices);
    worst = std::max(worst, WorstOf(report, diagnosis));
    PrintLine(arguments.json ? AsJson(time_s, report, diagnosis) : AsText(report, diagnosis));
    FORESIGHT_CHECK(CheckOutput());  // nobody reads on
  }
  return worst == DeviceCondition::kWell ? ExitCode::kDone : ExitCode::kNegative;
}

Result<ExitCode> ShowHealth(const HealthArguments& arguments, const RunContext& context) {
  if (!arguments.link.head.empty()) {
    HeadElsewhere head(arguments.link);
    return Report(head, arguments, context);
  }
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
  AddLinkOptions(*command, arguments->link)->excludes(config)->excludes(emulate);
  AddEmulationOptions(*command, emulate, arguments->emulation);
  command->add_option("--seconds", arguments->seconds, "End after so long; default: when stopped")
      ->check(CLI::Range(1.0, 1e9));
  command->add_flag("--json", arguments->json, "One JSON object a second");
  command->callback([&invocation, arguments] {
    if (arguments->head_config.empty() && arguments->emulation.scene.empty() &&
        arguments->link.head.empty())
      throw CLI::RequiredError("--head-config, --emulate or --head");
    invocation = [arguments](const RunContext& context) { return ShowHealth(*arguments, context); };
  });
}

}  // namespace foresight
