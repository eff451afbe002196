// foresight-head: the program on the robot. It owns the head's devices and executes scans into
// mission files.
#include <CLI/CLI.hpp>
#include <exception>
#include <memory>

#include "app/common/emulation.h"
#include "app/common/output.h"
#include "app/common/record_scan.h"
#include "app/common/run_program.h"
#include "core/base/atomic_file.h"
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
  bool json = false;
};

/// The devices that are emulated here, if any, and the head on them, through the sockets.
struct HeadBench {
  std::unique_ptr<EmulatedDevices> emulated;
  std::unique_ptr<SensorHead> head;  ///< last: goes first
};

Result<HeadBench> SetUp(const Arguments& arguments) {
  HeadBench bench;
  if (!arguments.emulation.scene.empty()) {
    FORESIGHT_TRY(bench.emulated, StartEmulation(arguments.emulation));
    bench.head = MakeRealHead(ConfigFor(*bench.emulated));
    return bench;
  }
  FORESIGHT_TRY(const HeadConfig config, LoadHeadConfig(arguments.head_config));
  bench.head = MakeRealHead(config);
  return bench;
}

Result<ExitCode> Run(const Arguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const std::string json, ReadFile(arguments.plan));
  FORESIGHT_TRY(const ScanPlan plan, PlanFromJson(json, arguments.plan));
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_TRY(const HeadBench bench, SetUp(arguments));
  if (!arguments.calibration.empty()) {
    FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(arguments.calibration));
    FORESIGHT_CHECK(bench.head->SetRig(rig));
  }
  return RecordScan(*bench.head, plan, arguments.out, arguments.json, context);
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
  app.add_option("--scan", arguments.plan, "Scan plan (JSON) to execute")->required();
  app.add_option("-o,--out", arguments.out, "Mission file; a scan is added to one that exists")
      ->required();
  app.add_flag("--json", arguments.json, "Print the result as JSON");
  app.set_version_flag("--version", std::string("foresight-head ") + ProgramVersion());
  app.final_callback([&] {
    if (config->empty() && emulate->empty()) throw CLI::RequiredError("--head-config or --emulate");
  });
  return RunProgram("foresight-head", app, argc, argv,
                    [&](const RunContext& context) { return Run(arguments, context); });
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  try {
    return foresight::Main(argc, argv);
  } catch (const std::exception& error) {
    foresight::PrintNote("foresight-head: internal error: {}", error.what());
    return static_cast<int>(foresight::ExitCode::kBadData);
  }
}
