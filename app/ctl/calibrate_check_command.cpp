#include <filesystem>
#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/open_scan.h"
#include "core/calibration/session_file.h"
#include "core/selfcheck/check_rig.h"
#include "core/selfcheck/check_session.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

struct CheckArguments {
  ScanArguments scan;  ///< its mission may be a session's folder
  std::string rig;     ///< empty = the one that was in force
  bool json = false;
};

nlohmann::ordered_json FindingsJson(const std::vector<RigFinding>& findings) {
  auto json = nlohmann::ordered_json::array();
  for (const RigFinding& finding : findings)
    json.push_back({{"name", finding.name},
                    {"state", ToString(finding.state)},
                    {"value", FiniteOrNull(finding.value)},
                    {"sigma", FiniteOrNull(finding.sigma)},
                    {"limit", FiniteOrNull(finding.limit)},
                    {"unit", finding.unit}});
  return json;
}

void PrintSentences(const char* title, const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) PrintLine(fmt::format("{:<11}{}", title, sentence));
}

ExitCode ExitFor(bool drifted) {
  return drifted ? ExitCode::kNegative : ExitCode::kDone;
}

Result<ExitCode> CheckOnScan(const CheckArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(OpenedScan opened, OpenScanWithoutImage(arguments.scan));
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(opened.scan.rig, LoadSensorRig(arguments.rig));
  }
  const auto check = CheckRig(opened.scan, RigCheckOptions(), context);
  // What a scan cannot say is no verdict on the rig.
  if (!check && check.error().code != ErrorCode::kCancelled)
    return Fail(ErrorCode::kInvalidInput, "{}: scan {}: {}", arguments.scan.mission, opened.id,
                check.error().message);
  if (!check) return tl::unexpected(check.error());
  if (arguments.json) {
    nlohmann::ordered_json json = {{"rig_id", RigId(opened.scan.rig)},
                                   {"scan", opened.scan.uuid},
                                   {"fine", !check->Drifted() && check->SawAnything()},
                                   {"drifted", check->drifted},
                                   {"cannot_see", check->cannot_see},
                                   {"findings", FindingsJson(check->findings)}};
    if (check->camera)
      json["camera"] = {{"depth_edges", check->camera->edges},
                        {"images", check->camera->images},
                        {"score", check->camera->score},
                        {"score_before", check->camera->score_before},
                        {"score_aside", check->camera->score_aside},
                        {"gain_sigmas", check->camera->gain_sigmas}};
    if (check->turns)
      json["turns"] = {{"images", check->turns->images},
                       {"points", check->turns->points},
                       {"explained", check->turns->explained},
                       {"spread_rad", check->turns->spread_rad}};
    if (check->passes)
      json["passes"] = {{"patches", check->passes->patches},
                        {"speed_rad_s", check->passes->speed_rad_s}};
    if (check->plate)
      json["plate"] = {{"planes", check->plate->planes},
                       {"cells", check->plate->cells},
                       {"up_and_down", check->plate->up_and_down},
                       {"residual_mm", 1000.0 * check->plate->residual_m}};
    PrintJson(json);
  } else {
    PrintSentences("drifted", check->drifted);
    PrintSentences("not seen", check->cannot_see);
    if (!check->Drifted() && check->SawAnything())
      PrintLine(fmt::format("fine       rig {}", ShortRigId(opened.scan.rig)));
  }
  if (!check->SawAnything())
    return Fail(ErrorCode::kInvalidInput,
                "{}: scan {} says nothing of its rig: scan a room with walls and things in it, up "
                "and down, with an image",
                arguments.scan.mission, opened.id);
  return ExitFor(check->Drifted());
}

Result<ExitCode> CheckOnSession(const CheckArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const CalibrationSession session,
                ReadCalibrationSession(arguments.scan.mission, context.Part(0.0, 0.5)));
  SensorRig rig = session.prior;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(rig, LoadSensorRig(arguments.rig));
  }
  const auto check = CheckSession(session, rig, SessionCheckLimits(), context.Part(0.5, 1.0));
  if (!check && check.error().code != ErrorCode::kCancelled)
    return Fail(ErrorCode::kInvalidInput, "{}: {}", arguments.scan.mission, check.error().message);
  if (!check) return tl::unexpected(check.error());
  if (arguments.json) {
    PrintJson({{"rig_id", RigId(rig)},
               {"session", session.name},
               {"fine", !check->Drifted()},
               {"drifted", check->drifted},
               {"mean_error_px", check->mean_error_px},
               {"range_rms_mm", 1000.0 * check->range_rms_m},
               {"findings", FindingsJson(check->findings)},
               {"notes", check->notes}});
  } else {
    PrintSentences("drifted", check->drifted);
    PrintSentences("note", check->notes);
    PrintLine(fmt::format("{:<11}corners {:.3f} px in the mean, lidar {:.1f} mm rms",
                          check->Drifted() ? "residuals" : "fine", check->mean_error_px,
                          1000.0 * check->range_rms_m));
  }
  return ExitFor(check->Drifted());
}

}  // namespace

void AddCalibrateCheckCommand(CLI::App& calibrate, Invocation& invocation) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = calibrate.add_subcommand(
      "check",
      "Whether a rig still fits: on a scan of any room (a mission), or on a session of boards "
      "(a folder)");
  AddMissionArguments(*command, arguments->scan);
  command->add_option("--rig", arguments->rig,
                      "The rig to check (YAML); else the scan's or the session's own");
  command->add_flag("--json", arguments->json, "Print the verdict and all values as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return std::filesystem::is_directory(arguments->scan.mission)
                 ? CheckOnSession(*arguments, context)
                 : CheckOnScan(*arguments, context);
    };
  });
}

}  // namespace foresight
