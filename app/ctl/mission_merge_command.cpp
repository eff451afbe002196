#include <algorithm>
#include <memory>

#include "app/ctl/command.h"
#include "core/mission/merge_missions.h"
#include "core/mission/mission_file.h"

namespace foresight {
namespace {

struct MergeArguments {
  std::vector<std::string> files;
  std::string out;
  bool json = false;
};

struct PruneArguments {
  std::string file;
  std::string out;
  std::vector<std::int64_t> keep;
  std::vector<std::int64_t> drop;
  bool with_objects = false;
  bool complete = false;
  bool json = false;
};

void Print(const std::string& out, const MergeReport& report, bool json) {
  if (json) {
    PrintJson({{"out", out},
               {"scans", report.scans},
               {"already_there", report.already_there},
               {"left_out", report.left_out},
               {"detections", report.detections},
               {"depth_maps", report.depth_maps},
               {"notes", report.notes},
               {"events", report.events}});
    return;
  }
  std::string text =
      fmt::format("{}: {} scans, {} detections, {} depth maps, {} notes, {} lines of the log", out,
                  report.scans, report.detections, report.depth_maps, report.notes, report.events);
  if (report.already_there > 0)
    text += fmt::format("; {} scans were in more than one file", report.already_there);
  if (report.left_out > 0) text += fmt::format("; {} scans were left out", report.left_out);
  PrintLine(text);
}

Result<ExitCode> Merge(const MergeArguments& arguments, const RunContext& context) {
  const std::vector<std::filesystem::path> sources(arguments.files.begin(), arguments.files.end());
  FORESIGHT_TRY(const MergeReport report, MergeMissions(sources, arguments.out, {}, context));
  Print(arguments.out, report, arguments.json);
  return ExitCode::kDone;
}

/// A scan that was named must be there.
Status CheckNamed(const PruneArguments& arguments, const std::vector<ScanSummary>& scans) {
  for (const auto* ids : {&arguments.keep, &arguments.drop})
    for (const std::int64_t id : *ids)
      if (std::none_of(scans.begin(), scans.end(),
                       [id](const ScanSummary& scan) { return scan.id == id; }))
        return Fail(ErrorCode::kInvalidOptions, "{}: there is no scan {}", arguments.file, id);
  return {};
}

Result<ExitCode> Prune(const PruneArguments& arguments, const RunContext& context) {
  if (arguments.keep.empty() && arguments.drop.empty() && !arguments.with_objects &&
      !arguments.complete)
    return Fail(ErrorCode::kInvalidOptions,
                "mission prune: say which scans stay (--keep, --with-objects, --complete) or go "
                "(--drop)");
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  FORESIGHT_CHECK(CheckNamed(arguments, scans));
  const auto has = [](const std::vector<std::int64_t>& ids, std::int64_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  MergeOptions options;
  options.keep = [&](const ScanSummary& scan) {
    if (!arguments.keep.empty() && !has(arguments.keep, scan.id)) return false;
    if (arguments.with_objects && scan.objects == 0) return false;
    if (arguments.complete && scan.state != ScanState::kComplete) return false;
    return !has(arguments.drop, scan.id);
  };
  const std::vector<std::filesystem::path> sources = {arguments.file};
  FORESIGHT_TRY(const MergeReport report, MergeMissions(sources, arguments.out, options, context));
  Print(arguments.out, report, arguments.json);
  return ExitCode::kDone;
}

}  // namespace

void AddMissionMergeCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command =
      mission.add_subcommand("merge", "Write one mission with the scans of several");
  command->add_option("files", arguments->files, "Mission files and reviews of them")->required();
  command->add_option("-o,--out", arguments->out, "Mission file to write")->required();
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Merge(*arguments, context); };
  });
}

void AddMissionPruneCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<PruneArguments>();
  CLI::App* command = mission.add_subcommand(
      "prune", "Write a smaller mission with chosen scans; the file itself stays as it is");
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_option("-o,--out", arguments->out, "Mission file to write")->required();
  command->add_option("--keep", arguments->keep, "Only these scans")->delimiter(',');
  command->add_option("--drop", arguments->drop, "All but these scans")->delimiter(',');
  command->add_flag("--with-objects", arguments->with_objects,
                    "Only scans in which something was found");
  command->add_flag("--complete", arguments->complete, "Only scans that were completed");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Prune(*arguments, context); };
  });
}

}  // namespace foresight
