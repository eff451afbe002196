// foresight-head: the program on the robot. It owns the head's devices, and executes scans into
// mission files or serves stations over the link.
#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <optional>

#include "app/common/emulation.h"
#include "app/common/output.h"
#include "app/common/record_scan.h"
#include "app/common/run_program.h"
#include "app/common/simulated_stand.h"
#include "app/head/listen.h"
#include "core/base/atomic_file.h"
#include "core/base/memory.h"
#include "core/base/version.h"
#include "core/mission/plan_json.h"
#include "hardware/assembly/real_head.h"

namespace foresight {
namespace {

struct Arguments {
  std::string head_config;
  EmulationArguments emulation;
  std::string calibration;  ///< in place of the head's own; empty = that
  std::string plan;
  std::string out;
  std::optional<double> operator_timeout_s;  ///< not given: the configuration's, or the link's
  ListenArguments listen;
  bool json = false;
};

/// A station may be silent for the longest blackout of a known link, 30 s, and find its link again.
constexpr double kLinkOperatorTimeout_s = 40.0;

CLI::Option* AddListenOptions(CLI::App& app, ListenArguments& arguments) {
  CLI::Option* listen =
      app.add_option("--listen", arguments.address,
                     "Serve stations on this address, HOST:PORT, until told to end "
                     "(default: 0.0.0.0:47130)")
          ->expected(0, 1)
          ->default_str("0.0.0.0:47130");
  CLI::Option* keys = app.add_option("--link-keys", arguments.keys,
                                     "Folder of this head's keys (default: /etc/foresight/link)")
                          ->needs(listen);
  app.add_flag("--plaintext", arguments.plaintext, "Without encryption, on a loopback address only")
      ->needs(listen)
      ->excludes(keys);
  app.add_option("--scans", arguments.scans,
                 "Folder that keeps the scans (default: the user's data folder)")
      ->needs(listen);
  app.add_option("--disk-ratio", arguments.disk_ratio, "Of the disk that scans may take")
      ->needs(listen)
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
  app.add_option("--lease", arguments.lease_s,
                 "Seconds without a sign of life after which another operator may take control")
      ->needs(listen)
      ->check(CLI::Range(1.0, 86400.0))
      ->capture_default_str();
  app.add_option("--burst-rate", arguments.burst_mbit_s,
                 "Mbit/s of the one-way path on which a station asks for bursts; 0: send none")
      ->needs(listen)
      ->check(CLI::Range(0.0, 10'000.0))
      ->capture_default_str();
  app.add_option("--robot-socket", arguments.robot_socket,
                 "Local socket from which the robot's software takes accepted poses")
      ->needs(listen);
  app.add_flag("!--no-announce", arguments.announce,
               "Do not tell the local network by mDNS that a head listens")
      ->needs(listen);
  return listen;
}

/// The devices that are emulated here, if any, and the head on them, through the sockets.
struct HeadBench {
  std::unique_ptr<EmulatedDevices> emulated;
  bool simulated = false;
  std::shared_ptr<SensorHead> head;  ///< last: goes first
};

Result<HeadBench> SetUp(const Arguments& arguments) {
  HeadBench bench;
  if (!arguments.emulation.scene.empty()) {
    FORESIGHT_TRY(bench.emulated, StartEmulation(arguments.emulation));
  }
  HeadConfig config;
  if (bench.emulated) {
    config = ConfigFor(*bench.emulated);
  } else {
    FORESIGHT_TRY(config, LoadHeadConfig(arguments.head_config));
  }
  if (!arguments.listen.address.empty()) config.capture.operator_timeout_s = kLinkOperatorTimeout_s;
  if (arguments.operator_timeout_s)
    config.capture.operator_timeout_s = *arguments.operator_timeout_s;
  bench.simulated = config.simulated;
  bench.head = MakeRealHead(config);
  return bench;
}

Result<ExitCode> Run(const Arguments& arguments, const RunContext& context) {
  std::optional<ScanPlan> plan;
  if (arguments.listen.address.empty()) {
    FORESIGHT_TRY(const std::string json, ReadFile(arguments.plan));
    FORESIGHT_TRY(plan, PlanFromJson(json, arguments.plan));
    FORESIGHT_CHECK(plan->Check());
  }
  FORESIGHT_TRY(const HeadBench bench, SetUp(arguments));
  if (!arguments.calibration.empty()) {
    FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(arguments.calibration));
    FORESIGHT_CHECK(bench.head->SetRig(rig));
  }
  const auto stand = bench.emulated ? StandIn(bench.emulated->world()) : nullptr;
  if (!plan) return Listen(bench.head, bench.simulated, stand.get(), arguments.listen, context);
  return RecordScan(*bench.head, *plan, arguments.out, arguments.json, context);
}

int Main(int argc, char** argv) {
  CLI::App app{"foresight-head: drives a head's lidar, motor and camera"};
  Arguments arguments;
  CLI::Option* config =
      app.add_option("--head-config", arguments.head_config, "The head and its devices (YAML)");
  CLI::Option* emulate =
      app.add_option("--emulate", arguments.emulation.scene,
                     "Scene file (YAML): emulate the devices in this process, on real sockets");
  config->excludes(emulate);
  AddEmulationOptions(app, emulate, arguments.emulation);
  app.add_option("--calibration", arguments.calibration,
                 "Calibration to put in force (YAML), in place of the head's");
  CLI::Option* scan = app.add_option("--scan", arguments.plan, "Scan plan (JSON) to execute");
  app.add_option("-o,--out", arguments.out, "Mission file; a scan is added to one that exists")
      ->needs(scan);
  app.add_option("--operator-timeout", arguments.operator_timeout_s,
                 "Seconds without a sign of the operator after which a sweep is ended, 0 = it is "
                 "finished (default: 40 with --listen, else the configuration's)")
      ->check(CLI::Range(0.0, 86400.0));
  CLI::Option* listen = AddListenOptions(app, arguments.listen)->excludes(scan);
  app.add_flag("--json", arguments.json, "Print the result as JSON");
  app.set_version_flag("--version", std::string("foresight-head ") + ProgramVersion());
  app.final_callback([&] {
    if (config->empty() && emulate->empty()) throw CLI::RequiredError("--head-config or --emulate");
    if (scan->empty() && listen->empty()) throw CLI::RequiredError("--scan or --listen");
    if (!scan->empty() && arguments.out.empty()) throw CLI::RequiredError("--out");
    arguments.listen.json = arguments.json;
  });
  return RunProgram("foresight-head", app, argc, argv,
                    [&](const RunContext& context) { return Run(arguments, context); });
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  foresight::KeepFewArenas();
  try {
    return foresight::Main(argc, argv);
  } catch (const std::exception& error) {
    foresight::PrintNote("foresight-head: internal error: {}", error.what());
    return static_cast<int>(foresight::ExitCode::kBadData);
  }
}
