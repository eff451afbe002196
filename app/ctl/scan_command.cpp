#include <filesystem>
#include <memory>
#include <optional>

#include "app/common/connect_head.h"
#include "app/common/record_scan.h"
#include "app/common/seed_option.h"
#include "app/common/simulated_bench.h"
#include "app/ctl/command.h"
#include "core/geometry/angles.h"
#include "hardware/assembly/real_head.h"
#include "hardware/link/client/remote_head.h"

namespace foresight {
namespace {

struct ScanCommandArguments {
  SimulationArguments simulation;
  std::string head_config;  ///< of a real head, in place of the simulation
  LinkArguments link;       ///< to a head elsewhere
  std::string calibration;  ///< in place of the head's own; empty = that
  double from_deg = -30.0;
  double to_deg = 30.0;
  double speed_deg_s = 10.0;
  std::vector<double> image_deg;
  std::optional<double> exposure_ms;  ///< not given: the head's
  bool stop_and_shoot = false;
  double max_blur_px = ScanPlan().max_blur_px;
  int passes = 1;
  std::string out;
  bool predict = false;
  bool json = false;
};

ScanPlan PlanFrom(const ScanCommandArguments& arguments, const CameraSettings& usual) {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(arguments.from_deg);
  plan.to_rad = RadiansFromDegrees(arguments.to_deg);
  plan.speed_rad_s = RadiansFromDegrees(arguments.speed_deg_s);
  plan.exposure_s = arguments.exposure_ms ? 1e-3 * *arguments.exposure_ms : usual.exposure_s;
  plan.gain_db = usual.gain_db;
  if (arguments.stop_and_shoot) plan.image_mode = ScanPlan::ImageMode::kStopAndShoot;
  plan.max_blur_px = arguments.max_blur_px;
  plan.passes = arguments.passes;
  plan.image_angles_rad.clear();
  for (const double angle : arguments.image_deg)
    plan.image_angles_rad.push_back(RadiansFromDegrees(angle));
  if (plan.image_angles_rad.empty()) plan.image_angles_rad = {0.5 * (plan.from_rad + plan.to_rad)};
  return plan;
}

nlohmann::ordered_json ToJson(const ScanPrediction& prediction) {
  return {{"duration_s", prediction.duration_s},
          {"lines", prediction.lines},
          {"density", prediction.density},
          {"line_spacing_px", prediction.line_spacing_px},
          {"beam_spacing_px", prediction.beam_spacing_px},
          {"sigma_spatial_px", prediction.sigma_spatial_px},
          {"exposure_s", prediction.exposure_s},
          {"blur_px", prediction.blur_px},
          {"fastest_speed_deg_s", DegreesFromRadians(prediction.fastest_speed_rad_s)},
          {"bytes", prediction.bytes}};
}

Result<ExitCode> Predict(const ScanCommandArguments& arguments, const ScanPlan& plan) {
  SensorRig rig = DefaultSensorRig();
  if (!arguments.simulation.rig.empty()) {
    FORESIGHT_TRY(rig, LoadSensorRig(arguments.simulation.rig));
  }
  FORESIGHT_TRY(const ScanPrediction prediction, PredictScan(plan, rig));
  if (arguments.json)
    PrintJson(ToJson(prediction));
  else
    PrintLine(ToText(prediction));
  return prediction.density < ScanPrediction::kMinDensity ? ExitCode::kNegative : ExitCode::kDone;
}

Status PutCalibrationInForce(SensorHead& head, const std::string& file) {
  if (file.empty()) return {};
  FORESIGHT_TRY(const SensorRig rig, LoadSensorRig(file));
  return head.SetRig(rig);
}

/// What has come when this ends early is where foresightctl fetch looks for it.
Result<ExitCode> ScanOverLink(const ScanCommandArguments& arguments, const RunContext& context) {
  const std::string spool = arguments.out + ".spool";
  FORESIGHT_TRY(const auto head, ConnectHead(arguments.link, HeadUse::kOperate, nullptr, spool));
  FORESIGHT_CHECK(PutCalibrationInForce(*head, arguments.calibration));
  auto scanned = RecordScan(*head, PlanFrom(arguments, {}), arguments.out, arguments.json, context);
  std::error_code not_empty;
  std::filesystem::remove(spool, not_empty);
  return scanned;
}

Result<ExitCode> ScanOnBench(const ScanCommandArguments& arguments, const RunContext& context) {
  FORESIGHT_CHECK(PlanFrom(arguments, {}).Check());
  if (arguments.predict) return Predict(arguments, PlanFrom(arguments, {}));
  if (!arguments.head_config.empty()) {
    FORESIGHT_TRY(const HeadConfig config, LoadHeadConfig(arguments.head_config));
    const auto head = MakeRealHead(config);
    FORESIGHT_CHECK(PutCalibrationInForce(*head, arguments.calibration));
    return RecordScan(*head, PlanFrom(arguments, config.exposure), arguments.out, arguments.json,
                      context);
  }
  if (!arguments.link.head.empty()) {
    return ScanOverLink(arguments, context);
  }
  FORESIGHT_TRY(const SimulatedBench bench, SetUpBench(arguments.simulation));
  FORESIGHT_CHECK(PutCalibrationInForce(*bench.head, arguments.calibration));
  return RecordScan(*bench.head, PlanFrom(arguments, {}), arguments.out, arguments.json, context);
}

}  // namespace

void AddScanCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ScanCommandArguments>();
  CLI::App* command =
      app.add_subcommand("scan", "Execute a scan with a simulated or a real head and record it");
  command->add_option("--scene", arguments->simulation.scene, "Scene file (YAML)");
  command->add_option("--rig", arguments->simulation.rig,
                      "The head as it is (YAML); default: the built-in one");
  AddSeedOption(*command, "--seed", arguments->simulation.seed, "Seed of all noise")
      ->capture_default_str();
  command->add_flag("--real-time", arguments->simulation.real_time,
                    "Let the sweep take its real time");
  command
      ->add_option("--head-config", arguments->head_config,
                   "A real head and its devices (YAML), in place of a scene")
      ->excludes("--scene")
      ->excludes("--rig")
      ->excludes("--seed")
      ->excludes("--real-time");
  CLI::Option* head = AddLinkOptions(*command, arguments->link);
  for (const char* other : {"--scene", "--rig", "--seed", "--real-time", "--head-config"})
    head->excludes(other);
  command->add_option("--calibration", arguments->calibration,
                      "Calibration to put in force (YAML), in place of the head's");
  AddOption(*command, "--from", arguments->from_deg,
            "Begin of the scope in degrees, up is positive");
  AddOption(*command, "--to", arguments->to_deg, "End of the scope in degrees");
  AddOption(*command, "--speed", arguments->speed_deg_s, "Degrees a second");
  command
      ->add_option("--images", arguments->image_deg,
                   "Angles of images in degrees; default: the middle")
      ->delimiter(',');
  command->add_option("--exposure", arguments->exposure_ms,
                      "Exposure in milliseconds; default: the head's");
  command->add_flag("--stop-and-shoot", arguments->stop_and_shoot,
                    "Take the images after the sweep, standing still");
  AddOption(*command, "--max-blur", arguments->max_blur_px,
            "Most motion blur of an image taken in passing, in pixels: caps the exposure");
  AddOption(*command, "--passes", arguments->passes, "1: one way; 2: there and back in one scan");
  command->add_option("-o,--out", arguments->out,
                      "Mission file; a scan is added to one that exists");
  command->add_flag("--predict", arguments->predict, "Only say what the plan would cost and give");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    const bool no_head = arguments->simulation.scene.empty() && arguments->head_config.empty() &&
                         arguments->link.head.empty();
    if (!arguments->predict && no_head)
      throw CLI::RequiredError("--scene, --head-config or --head");
    if (!arguments->predict && arguments->out.empty()) throw CLI::RequiredError("--out");
    invocation = [arguments](const RunContext& context) {
      return ScanOnBench(*arguments, context);
    };
  });
}

}  // namespace foresight
