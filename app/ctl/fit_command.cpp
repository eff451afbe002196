#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "app/ctl/open_scan.h"
#include "app/ctl/save_valve.h"
#include "core/detection/detection_json.h"
#include "core/detection/fit_in_scan.h"
#include "core/registration/register_scan.h"

namespace foresight {
namespace {

struct FitArguments {
  ScanArguments scan;
  DepthArguments depth;
  std::vector<double> roi;
  std::string source = "raw";
  std::uint64_t seed = 1;
  bool save = false;
  bool json = false;
};

/// The scan up to the point that the source needs, and the fit in it.
Result<ValveDetection> FitIn(const FitArguments& arguments, const OpenedScan& opened,
                             const RunContext& context) {
  const SensorRig& rig = opened.scan.rig;
  const double motor_rad = opened.frame.motor_angle_rad;
  const ImageRoi roi = ImageRoi::Rectangle(motor_rad, {arguments.roi[0], arguments.roi[1]},
                                           {arguments.roi[2], arguments.roi[3]});
  FORESIGHT_CHECK(roi.Check());
  FORESIGHT_TRY(const DepthOptions depth_options, DepthOptionsFrom(arguments.depth));
  FitValveOptions options;
  options.seed = arguments.seed;
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(opened.scan, context.Part(0.0, 0.1)));
  if (arguments.source == "raw")
    return FitValveInScan({rig, cloud}, FitSource::kRaw, roi, options, context.Part(0.1, 1.0));
  FORESIGHT_TRY(
      const DepthResult depth,
      ComputeDepthInFrame(cloud, rig, opened.frame, depth_options, context.Part(0.1, 0.6)));
  return FitValveInScan({rig, cloud, &depth}, FitSource::kDepth, roi, options,
                        context.Part(0.6, 1.0));
}

Status Save(const FitArguments& arguments, std::int64_t scan_id, const ValveDetection& detection,
            const SensorRig& rig) {
  FORESIGHT_TRY(const std::unique_ptr<MissionFile> mission,
                MissionFile::Open(arguments.scan.mission));
  FORESIGHT_CHECK(SaveValve(*mission, scan_id, detection, rig));
  return mission->Close();
}

void PrintSummary(const ValveDetection& d, const SensorRig& rig) {
  const Eigen::Vector3d centre = rig.robot_from_base * d.best.base_from_object.translation();
  const Eigen::Vector3d axis =
      rig.robot_from_base.Rotate(d.best.base_from_object.Rotate(Eigen::Vector3d::UnitZ()));
  PrintLine(fmt::format("{} ({:.0f} %): {}", ToString(d.verdict.level),
                        100.0 * d.verdict.probability, d.verdict.reason));
  PrintLine(fmt::format("centre in robot  {:.1f} {:.1f} {:.1f} mm, axis {:.4f} {:.4f} {:.4f}",
                        1000.0 * centre.x(), 1000.0 * centre.y(), 1000.0 * centre.z(), axis.x(),
                        axis.y(), axis.z()));
  PrintLine(fmt::format("rim diameter     {:.1f} mm, {} spokes", 2000.0 * d.best.model.rim_radius_m,
                        d.best.model.spokes));
}

/// There is an answer, and it is no: whoever reads JSON wants it as JSON.
bool IsNegative(const Error& error) {
  return error.code == ErrorCode::kTooFewPoints || error.code == ErrorCode::kNoConvergence;
}

Result<ExitCode> FitValveCommand(const FitArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const OpenedScan opened, OpenScan(arguments.scan));
  const auto found = FitIn(arguments, opened, context);
  if (!found && arguments.json && IsNegative(found.error()))
    PrintJson({{"kind", "valve"},
               {"verdict", "UNSURE"},
               {"probability", 0.0},
               {"reason", found.error().message}});
  FORESIGHT_TRY(const ValveDetection detection, found);
  if (arguments.save) FORESIGHT_CHECK(Save(arguments, opened.id, detection, opened.scan.rig));
  if (arguments.json)
    PrintLine(DetectionToJson(detection, opened.scan.rig.robot_from_base));
  else
    PrintSummary(detection, opened.scan.rig);
  return detection.verdict.level == VerdictLevel::kUnsure ? ExitCode::kNegative : ExitCode::kDone;
}

}  // namespace

void AddFitCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* fit = app.add_subcommand("fit", "Fit a known object in a region of a scan");
  fit->require_subcommand(1);
  const auto arguments = std::make_shared<FitArguments>();
  CLI::App* valve = fit->add_subcommand("valve", "Fit a wheel valve");
  AddScanArguments(*valve, arguments->scan);
  AddDepthArguments(*valve, arguments->depth);
  valve
      ->add_option("--roi", arguments->roi,
                   "Region in the picture: left top right bottom, in pixels")
      ->expected(4)
      ->delimiter(',')
      ->required();
  valve
      ->add_option("--source", arguments->source,
                   "What to fit: raw (lidar returns) or depth (masked dense depth)")
      ->check(CLI::IsMember({"raw", "depth"}))
      ->capture_default_str();
  valve->add_option("--seed", arguments->seed, "Seed of the random search")->capture_default_str();
  valve->add_flag("--save", arguments->save, "Write the answer into the mission file");
  valve->add_flag("--json", arguments->json, "Print the answer as JSON");
  valve->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return FitValveCommand(*arguments, context);
    };
  });
}

}  // namespace foresight
