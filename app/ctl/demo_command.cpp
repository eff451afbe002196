#include <memory>

#include "app/common/execute_scan.h"
#include "app/common/seed_option.h"
#include "app/common/simulated_bench.h"
#include "app/ctl/command.h"
#include "app/ctl/demo_report.h"
#include "core/depth/depth_method.h"
#include "core/detection/fit_in_scan.h"
#include "core/geometry/angles.h"
#include "core/mission/new_records.h"

namespace foresight {
namespace {

struct DemoArguments {
  SimulationArguments simulation;
  std::string out = "demo";
  bool json = false;
};

/// Wide enough for valve, drill and blocks of the room.
ScanPlan DemoPlan() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-50.0);
  plan.to_rad = RadiansFromDegrees(20.0);
  plan.speed_rad_s = RadiansFromDegrees(10.0);
  plan.image_angles_rad = {RadiansFromDegrees(-15.0)};
  return plan;
}

/// From the scan to the fit, as the operator's programs do it.
Status Process(const World& world, const ValveTruth& truth, DemoOutcome& outcome,
               const RunContext& context) {
  const CameraFrame* frame = NearestFrame(outcome.scan, DemoPlan().image_angles_rad.front());
  if (frame == nullptr) return Fail(ErrorCode::kDevice, "the scan came home without an image");
  outcome.frame = *frame;
  FORESIGHT_TRY(outcome.registered, RegisterScan(outcome.scan, context));
  FORESIGHT_TRY(outcome.depth, ComputeDepthInFrame(outcome.registered, outcome.scan.rig, *frame,
                                                   DefaultsOf(DepthMethod::kForesight), context));
  const auto roi = RegionOfTrueValve(truth, world, frame->motor_angle_rad);
  if (!roi)
    return Fail(ErrorCode::kInvalidInput, "{}: its valve is not in the image", world.scene().name);
  const DemoSubject subject{
      outcome.scan.rig, outcome.registered, outcome.depth, outcome.frame, *roi, truth, world};
  FORESIGHT_TRY(const std::vector<DemoAnswer> answers, FitToEverySource(subject, context));
  FORESIGHT_TRY(outcome.valve, answers.front().valve);
  outcome.sources = TableOf(answers);
  outcome.source_pictures = PicturesOf(answers, subject);
  outcome.error = CompareWithTruth(outcome.valve.best, truth, world);
  return {};
}

/// The valve, and the depth map as how it is made again, into the mission.
Status Keep(const DemoOutcome& outcome, std::int64_t scan_id, MissionFile& mission) {
  const ConfidenceMaskOptions& mask = outcome.depth.options.mask;
  FORESIGHT_TRY(const Provenance provenance,
                ProvenanceOfFit(outcome.scan, FitSource::kRaw, nullptr, mask, FitValveOptions(),
                                outcome.valve.origin.roi));
  DetectionRecord valve = NewDetectionRecord(outcome.scan, outcome.valve, provenance);
  FORESIGHT_TRY(DepthRecord depth,
                NewDepthRecord(outcome.scan, outcome.depth, outcome.depth.mask, mask));
  valve.scan_id = depth.scan_id = scan_id;
  FORESIGHT_CHECK(mission.AddDepth(depth));
  FORESIGHT_CHECK(mission.AddDetection(valve));
  return {};
}

void PrintOutcome(const DemoArguments& arguments, const DemoOutcome& o) {
  const std::string report = (std::filesystem::path(arguments.out) / "report.html").string();
  if (arguments.json) {
    PrintJson({{"report", report},
               {"mission", o.mission_file},
               {"verdict", ToString(o.valve.verdict.level)},
               {"probability", o.valve.verdict.probability},
               {"center_error_mm", 1000.0 * o.error.center_m},
               {"axis_error_deg", DegreesFromRadians(o.error.axis_rad)},
               {"radius_error_mm", 1000.0 * o.error.radius_m},
               {"spokes_right", o.error.spokes == 0},
               {"depth_seconds", o.depth.seconds},
               {"fit_seconds", o.valve.origin.seconds}});
    return;
  }
  PrintLine("valve    " + AgainstTruth(o.valve.verdict, o.error));
  PrintLine("report   " + report);
  PrintLine("mission  " + o.mission_file);
}

Result<ExitCode> Demo(const DemoArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const SimulatedBench bench, SetUpBench(arguments.simulation));
  if (bench.world->scene().valves.empty())
    return Fail(ErrorCode::kInvalidInput, "{}: a demo mission needs a scene with a valve",
                arguments.simulation.scene);
  FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
  DemoOutcome outcome;
  outcome.mission_file = (std::filesystem::path(arguments.out) / "mission.foresight").string();
  PrintNote("scanning {}", bench.world->scene().name);
  FORESIGHT_TRY(const auto mission, OpenOrCreateMission(outcome.mission_file));
  FORESIGHT_TRY(const ExecutedScan executed,
                ExecuteScan(*bench.head, DemoPlan(), mission, context));
  FORESIGHT_TRY(outcome.scan, mission->LoadScan(executed.id));
  PrintNote("computing depth and fitting the valve to every source");
  FORESIGHT_CHECK(Process(*bench.world, bench.world->scene().valves.front(), outcome, context));
  FORESIGHT_CHECK(Keep(outcome, executed.id, *mission));
  FORESIGHT_CHECK(mission->Close());
  FORESIGHT_CHECK(WriteHtmlReport(ReportOf(outcome), arguments.out));
  PrintOutcome(arguments, outcome);
  return ExitCode::kDone;
}

}  // namespace

void AddDemoCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command = app.add_subcommand(
      "demo", "Run the demo mission: scan, depth, valve, and a report with images");
  command->add_option("--scene", arguments->simulation.scene, "Scene file (YAML) with a valve")
      ->required();
  AddSeedOption(*command, "--seed", arguments->simulation.seed, "Seed of all noise")
      ->capture_default_str();
  command->add_option("-o,--out", arguments->out, "Folder for the report and the mission file")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print the outcome as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Demo(*arguments, context); };
  });
}

}  // namespace foresight
