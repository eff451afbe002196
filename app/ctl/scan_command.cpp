#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/fly_scan.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

struct ScanCommandArguments {
  SimulationArguments simulation;
  double from_deg = -30.0;
  double to_deg = 30.0;
  double speed_deg_s = 10.0;
  std::vector<double> image_deg;
  double exposure_ms = 4.0;
  std::string out;
  bool predict = false;
  bool json = false;
};

ScanPlan PlanFrom(const ScanCommandArguments& arguments) {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(arguments.from_deg);
  plan.to_rad = RadiansFromDegrees(arguments.to_deg);
  plan.speed_rad_s = RadiansFromDegrees(arguments.speed_deg_s);
  plan.exposure_s = 1e-3 * arguments.exposure_ms;
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
          {"blur_px", prediction.blur_px},
          {"bytes", prediction.bytes}};
}

std::string ToText(const ScanPrediction& p) {
  return fmt::format(
      "{:.1f} s, {} lines, {:.1f} % of the pixels measured, sigma_s {:.1f} px, blur {:.2f} px, "
      "{:.1f} MB",
      p.duration_s, p.lines, 100.0 * p.density, p.sigma_spatial_px, p.blur_px,
      1e-6 * static_cast<double>(p.bytes));
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

void PrintScan(const ScanCommandArguments& arguments, const ScanSummary& scan) {
  if (arguments.json)
    PrintJson({{"mission", arguments.out},
               {"scan", scan.id},
               {"uuid", scan.uuid},
               {"source", scan.source},
               {"state", ToString(scan.state)},
               {"reason", scan.reason},
               {"lines", scan.lines},
               {"frames", scan.frames}});
  else
    PrintLine(fmt::format("{}: scan {} {}, {} lines, {} pictures{}{}", arguments.out, scan.id,
                          ToString(scan.state), scan.lines, scan.frames,
                          scan.reason.empty() ? "" : ": ", scan.reason));
}

Result<ExitCode> ScanSite(const ScanCommandArguments& arguments, const RunContext& context) {
  const ScanPlan plan = PlanFrom(arguments);
  FORESIGHT_CHECK(plan.Check());
  if (arguments.predict) return Predict(arguments, plan);
  FORESIGHT_TRY(const SimulatedSite site, SetUpSite(arguments.simulation));
  FORESIGHT_TRY(const auto prediction, PredictScan(plan, site.head->Rig()));
  fmt::print(stderr, "{}: {}\n", site.head->Describe(), ToText(prediction));
  FORESIGHT_TRY(const auto mission, OpenOrCreateMission(arguments.out));
  FORESIGHT_TRY(const std::int64_t id, FlyScan(*site.head, plan, mission, context));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  FORESIGHT_CHECK(mission->Close());
  for (const ScanSummary& scan : scans) {
    if (scan.id != id) continue;
    PrintScan(arguments, scan);
    return scan.state == ScanState::kComplete ? ExitCode::kDone : ExitCode::kNegative;
  }
  return Fail(ErrorCode::kBadData, "{}: scan {} is missing after it was recorded", arguments.out,
              id);
}

}  // namespace

void AddScanCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<ScanCommandArguments>();
  CLI::App* command = app.add_subcommand("scan", "Fly a scan with a simulated head and record it");
  command->add_option("--scene", arguments->simulation.scene, "Scene file (YAML)");
  command->add_option("--rig", arguments->simulation.rig,
                      "The head as it is (YAML); default: the built-in one");
  command->add_option("--seed", arguments->simulation.seed, "Seed of all noise")
      ->capture_default_str();
  command->add_flag("--real-time", arguments->simulation.real_time,
                    "Let the sweep take its real time");
  command
      ->add_option("--from", arguments->from_deg, "Begin of the scope in degrees, up is positive")
      ->capture_default_str();
  command->add_option("--to", arguments->to_deg, "End of the scope in degrees")
      ->capture_default_str();
  command->add_option("--speed", arguments->speed_deg_s, "Degrees a second")->capture_default_str();
  command
      ->add_option("--images", arguments->image_deg,
                   "Angles of pictures in degrees; default: the middle")
      ->delimiter(',');
  command->add_option("--exposure", arguments->exposure_ms, "Exposure in milliseconds")
      ->capture_default_str();
  command->add_option("-o,--out", arguments->out,
                      "Mission file; a scan is added to one that exists");
  command->add_flag("--predict", arguments->predict, "Only say what the plan would cost and give");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    if (!arguments->predict && arguments->simulation.scene.empty())
      throw CLI::RequiredError("--scene");
    if (!arguments->predict && arguments->out.empty()) throw CLI::RequiredError("--out");
    invocation = [arguments](const RunContext& context) { return ScanSite(*arguments, context); };
  });
}

}  // namespace foresight
