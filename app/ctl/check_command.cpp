#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "app/ctl/open_scan.h"
#include "app/ctl/scan_check_report.h"
#include "core/geometry/angles.h"
#include "core/mission/gather_checks.h"
#include "core/mission/side_result.h"
#include "core/registration/register_scan.h"
#include "core/selfcheck/rig_damage.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

struct CheckArguments {
  ScanArguments scan;  ///< scan_id 0 = all scans
  std::string rig;     ///< empty = each scan's own
  DepthArguments depth;
  /// What the head is taken to have suffered since its calibration.
  std::vector<double> camera_turn_deg = {0.0, 0.0, 0.0};
  std::vector<double> lidar_turn_deg = {0.0, 0.0, 0.0};
  double stamp_ms = 0.0;
  bool no_objects = false;
  bool keep = false;
  bool json = false;
};

/// A scan that was checked.
struct CheckedScan {
  std::int64_t id = 0;
  SensorRig rig;  ///< that was checked
  ScanCheck check;
  KeptCheck kept;  ///< the same, as it is kept
};

Eigen::Vector3d Radians(const std::vector<double>& degrees) {
  return {RadiansFromDegrees(degrees[0]), RadiansFromDegrees(degrees[1]),
          RadiansFromDegrees(degrees[2])};
}

/// The image that was asked for; nullptr where the scan has none.
const CameraFrame* FrameOf(const Scan& scan, const ScanArguments& arguments) {
  const double middle_rad = 0.5 * (scan.plan.from_rad + scan.plan.to_rad);
  return NearestFrame(
      scan, arguments.image_deg > 90.0 ? middle_rad : RadiansFromDegrees(arguments.image_deg));
}

class MissionChecker {
 public:
  MissionChecker(const CheckArguments& arguments, const MissionFile& mission,
                 const MissionFile* review)
      : arguments_(arguments), mission_(mission), review_(review) {}

  Status Prepare() {
    FORESIGHT_TRY(options_.depth, DepthOptionsFrom(arguments_.depth));
    if (!arguments_.rig.empty()) {
      FORESIGHT_TRY(rig_, LoadSensorRig(arguments_.rig));
    }
    damage_ = {.name = "asked for",
               .camera_turn_rad = Radians(arguments_.camera_turn_deg),
               .lidar_turn_rad = Radians(arguments_.lidar_turn_deg),
               .stamp_s = 1e-3 * arguments_.stamp_ms};
    return {};
  }

  Result<CheckedScan> Check(std::int64_t id, const RunContext& context) const {
    CheckedScan checked;
    checked.id = id;
    FORESIGHT_TRY(Scan scan, mission_.LoadScan(id));
    std::vector<std::string> left_out;
    std::vector<KeptObject> objects;
    if (!arguments_.no_objects && !rig_ && damage_.IsNone()) {
      FORESIGHT_TRY(const std::vector<DetectionRecord> records,
                    DetectionsOfScan(mission_, review_, scan.uuid));
      objects = AcceptedObjects(scan, records, left_out);
    }
    if (rig_) scan.rig = *rig_;
    // Points of an import were placed by another program.
    if (!scan.given.empty() && (!damage_.lidar_turn_rad.isZero(0.0) || damage_.stamp_s != 0.0))
      return Fail(ErrorCode::kInvalidInput,
                  "the scan was imported: what a turned lidar or late stamps change of its points "
                  "is not known; --camera-turned works");
    scan.rig = RigBefore(damage_, scan.rig);
    FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(scan, context.Part(0.0, 0.1)));
    FORESIGHT_TRY(checked.check, CheckScan(scan, cloud, FrameOf(scan, arguments_.scan), objects,
                                           options_, context.Part(0.1, 1.0)));
    checked.check.cannot_see.insert(checked.check.cannot_see.end(), left_out.begin(),
                                    left_out.end());
    if (!damage_.IsNone())
      checked.check.cannot_see.insert(checked.check.cannot_see.begin(),
                                      "the head as it is: the rig was checked as if the head had "
                                      "been knocked, as the options say");
    checked.kept = NewKeptCheck(scan, checked.check, options_);
    checked.rig = std::move(scan.rig);
    return checked;
  }

 private:
  const CheckArguments& arguments_;
  const MissionFile& mission_;
  const MissionFile* review_;
  ScanCheckOptions options_;
  std::optional<SensorRig> rig_;
  RigDamage damage_;
};

nlohmann::ordered_json ScanJson(const CheckedScan& checked) {
  auto json = nlohmann::ordered_json::parse(checked.kept.answer_json);
  json["scan"] = checked.id;
  json["seconds"] = checked.check.seconds;
  return json;
}

nlohmann::ordered_json GatheredJson(const GatheredCheck& gathered, const SensorRig& rig) {
  auto json = nlohmann::ordered_json::parse(ScanCheckToJson(gathered.check, Scan(), {}));
  for (const char* of_one : {"scan_uuid", "depth", "depth_options", "objects"}) json.erase(of_one);
  json["rig_id"] = RigId(rig);
  json["scans"] = gathered.scans;
  return json;
}

/// The scans of the last scan's rig together; nothing where there is one alone.
std::optional<GatheredCheck> Gathered(const std::vector<CheckedScan>& all) {
  if (all.empty()) return std::nullopt;
  std::vector<KeptCheck> kept;
  for (const CheckedScan& checked : all) kept.push_back(checked.kept);
  return GatherChecks(kept, all.back().rig);
}

Status Keep(const std::string& mission, const std::vector<CheckedScan>& all) {
  FORESIGHT_TRY(const auto review, MissionFile::OpenReviewOf(mission));
  for (const CheckedScan& checked : all) FORESIGHT_CHECK(AddScanCheck(*review, checked.kept));
  return review->Close();
}

void Print(const CheckArguments& arguments, const std::vector<CheckedScan>& all,
           const std::optional<GatheredCheck>& gathered) {
  if (arguments.json) {
    auto scans = nlohmann::ordered_json::array();
    for (const CheckedScan& checked : all) scans.push_back(ScanJson(checked));
    nlohmann::ordered_json json = {{"mission", arguments.scan.mission}, {"scans", scans}};
    if (gathered) json["gathered"] = GatheredJson(*gathered, all.back().rig);
    PrintJson(json);
    return;
  }
  for (const CheckedScan& checked : all)
    PrintLine(fmt::format("scan {}, {:.1f} s\n{}", checked.id, checked.check.seconds,
                          ScanCheckText(checked.check)));
  if (gathered)
    PrintLine(
        fmt::format("{} scans together\n{}", gathered->scans, ScanCheckText(gathered->check)));
}

CheckLight Gravest(const std::vector<CheckedScan>& all,
                   const std::optional<GatheredCheck>& gathered) {
  CheckLight light = gathered ? gathered->check.light : CheckLight::kNotSeen;
  for (const CheckedScan& checked : all) light = std::max(light, checked.check.light);
  return light;
}

Result<ExitCode> Check(const CheckArguments& arguments, const RunContext& context) {
  const std::string& path = arguments.scan.mission;
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(path));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(path));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  MissionChecker checker(arguments, *mission, review.get());
  FORESIGHT_CHECK(checker.Prepare());
  std::vector<std::int64_t> wanted;
  for (const ScanSummary& scan : scans)
    if (arguments.scan.scan_id == 0 || scan.id == arguments.scan.scan_id) wanted.push_back(scan.id);
  if (wanted.empty())
    return arguments.scan.scan_id == 0
               ? Fail(ErrorCode::kInvalidInput, "{}: there is no scan to check", path)
               : Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", path,
                      arguments.scan.scan_id);
  std::vector<CheckedScan> all;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto count = static_cast<double>(wanted.size()), at = static_cast<double>(i);
    auto checked = checker.Check(wanted[i], context.Part(at / count, (at + 1.0) / count));
    if (!checked) {
      // One bad scan must not cost the others.
      if (wanted.size() == 1 || checked.error().code == ErrorCode::kCancelled)
        return tl::unexpected(Of(fmt::format("{}: scan {}", path, wanted[i]))(checked.error()));
      PrintNote("{}: scan {}: {}", path, wanted[i], checked.error().message);
      continue;
    }
    all.push_back(std::move(*checked));
  }
  const std::optional<GatheredCheck> gathered = Gathered(all);
  Print(arguments, all, gathered);
  if (arguments.keep) FORESIGHT_CHECK(Keep(path, all));
  const CheckLight light = Gravest(all, gathered);
  if (light == CheckLight::kNotSeen)
    return Fail(ErrorCode::kInvalidInput,
                "{}: nothing can be said: scan where walls and things that stand before others are "
                "in view, up and down, with an image",
                path);
  return light == CheckLight::kGood ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddCheckCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check",
      "What scans say about themselves: how good their depth is, whether camera, lidar and motor "
      "fit, and whether accepted objects hold");
  AddScanArguments(*command, arguments->scan);
  command->get_option("--scan")->description("Number of the scan, from 1; default: all of them");
  command->add_option("--rig", arguments->rig,
                      "Check this rig (YAML) in place of each scan's own; without objects");
  AddDepthArguments(*command, arguments->depth);
  std::vector<CLI::Option*> damages;
  const auto add_turn = [&](const char* name, std::vector<double>& turn_deg, const char* of) {
    damages.push_back(command
                          ->add_option(name, turn_deg,
                                       fmt::format("As if the {} had turned by X,Y,Z degrees about "
                                                   "its axes since the calibration: shows what the "
                                                   "check sees of it",
                                                   of))
                          ->delimiter(',')
                          ->expected(3)
                          ->check(CLI::Range(-10.0, 10.0)));
  };
  add_turn("--camera-turned", arguments->camera_turn_deg, "camera");
  add_turn("--lidar-turned", arguments->lidar_turn_deg, "lidar");
  damages.push_back(command
                        ->add_option("--stamps-late", arguments->stamp_ms,
                                     "As if the lidar's stamps were late by so many milliseconds")
                        ->check(CLI::Range(-100.0, 100.0)));
  command->add_flag("--no-objects", arguments->no_objects, "Do not fit accepted objects again");
  CLI::Option* keep = command->add_flag(
      "--keep", arguments->keep, "Keep the result with the scan, in the review beside the mission");
  for (CLI::Option* damage : damages) keep->excludes(damage);  // supposed, not measured
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Check(*arguments, context); };
  });
}

}  // namespace foresight
