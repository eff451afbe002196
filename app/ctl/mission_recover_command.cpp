#include <memory>

#include "app/ctl/command.h"
#include "core/mission/salvage_mission.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

struct RecoverArguments {
  std::string file;
  std::string out;
  std::string rig;
  bool json = false;
};

/// "19 of 20"; "19" where nobody knows how many there were.
std::string OutOf(std::int64_t count, std::int64_t before) {
  return before < 0 || before == count ? fmt::format("{}", count)
                                       : fmt::format("{} of {}", count, before);
}

nlohmann::ordered_json Known(std::int64_t count) {
  return count < 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(count);
}

void Print(const RecoverArguments& arguments, const SalvageReport& report) {
  if (arguments.json) {
    auto scans = nlohmann::ordered_json::array();
    for (const SalvagedScan& scan : report.scans)
      scans.push_back({{"scan", scan.id},
                       {"uuid", scan.uuid},
                       {"saved", scan.saved},
                       {"state", ToString(scan.state)},
                       {"lines", scan.lines},
                       {"lines_before", Known(scan.lines_before)},
                       {"images", scan.images},
                       {"images_before", Known(scan.images_before)}});
    PrintJson({{"file", arguments.file},
               {"out", arguments.out},
               {"scans", scans},
               {"detections", report.detections},
               {"depth_maps", report.depth_maps},
               {"notes", report.notes},
               {"events", report.events},
               {"losses", report.losses}});
    return;
  }
  std::string text = fmt::format(
      "{}: {} scans, {} detections, {} depth maps, {} notes, {} lines of the log", arguments.out,
      report.scans.size(), report.detections, report.depth_maps, report.notes, report.events);
  for (const SalvagedScan& scan : report.scans)
    text += fmt::format(
        "\nscan {}: {} lines, {} images, {}", scan.id, OutOf(scan.lines, scan.lines_before),
        OutOf(scan.images, scan.images_before), scan.saved ? ToString(scan.state) : "not saved");
  for (const std::string& loss : report.losses) text += "\nmissing: " + loss;
  text += report.losses.empty() ? "\nnothing is missing" : "";
  PrintLine(text);
}

Result<ExitCode> Recover(const RecoverArguments& arguments, const RunContext& context) {
  SalvageOptions options;
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(options.rig, LoadSensorRig(arguments.rig));
  }
  FORESIGHT_TRY(const SalvageReport report,
                SalvageMission(arguments.file, arguments.out, options, context));
  Print(arguments, report);
  return report.losses.empty() ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddMissionRecoverCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<RecoverArguments>();
  CLI::App* command = mission.add_subcommand(
      "recover", "Save what is whole in a damaged mission file into a new one");
  command->add_option("file", arguments->file, "Mission file, which is only read")->required();
  command->add_option("-o,--out", arguments->out, "Mission file to write")->required();
  command->add_option("--rig", arguments->rig,
                      "Rig file for scans whose own rig or entry is damaged");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Recover(*arguments, context); };
  });
}

}  // namespace foresight
