#include <algorithm>
#include <charconv>
#include <memory>
#include <set>

#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "core/base/atomic_file.h"
#include "core/detection/fit_option_table.h"
#include "core/mission/mission_file.h"
#include "core/mission/run_again.h"
#include "core/mission/side_result.h"
#include "core/options/option_text.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

struct RunArguments {
  std::vector<std::string> files;
  std::string out;
  std::string part = "1/1";
  std::string rig;
  std::string source;
  std::string keep;
  std::optional<std::int64_t> scan;
  std::vector<std::string> fit_options;
  DepthArguments depth;
  bool json = false;
};

/// The K-th of N equal parts.
struct Part {
  std::size_t which = 1;
  std::size_t of = 1;
};

Result<Part> ParsePart(const std::string& text) {
  Part part;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, part.which);
  if (error == std::errc() && slash != end && *slash == '/') {
    const auto [rest, second_error] = std::from_chars(slash + 1, end, part.of);
    if (second_error == std::errc() && rest == end && part.which >= 1 && part.which <= part.of)
      return part;
  }
  return Fail(ErrorCode::kInvalidOptions, "--part '{}': give it as K/N with K from 1 to N", text);
}

/// One scan of one of the missions.
struct Task {
  std::string mission;
  std::int64_t scan_id = 0;
  std::string uuid;
};

/// Every scan once, in the order of its uuid: the same list whatever the order of the files. `only`
/// = the scans of this number alone.
Result<std::vector<Task>> TasksOf(const std::vector<std::string>& files,
                                  std::optional<std::int64_t> only) {
  std::vector<Task> tasks;
  for (const std::string& file : files) {
    FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(file));
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
    for (const ScanSummary& scan : scans)
      if (!only || scan.id == *only) tasks.push_back({file, scan.id, scan.uuid});
  }
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const Task& a, const Task& b) { return a.uuid < b.uuid; });
  if (only && tasks.empty())
    return Fail(ErrorCode::kInvalidInput, "--scan {}: no file has a scan of this number", *only);
  tasks.erase(std::unique(tasks.begin(), tasks.end(),
                          [](const Task& a, const Task& b) { return a.uuid == b.uuid; }),
              tasks.end());
  return tasks;
}

/// What was found in the scan: in its mission, and in reviews among the files. Fits of side results
/// are no findings of their own.
Result<std::vector<DetectionRecord>> RecordsOf(const std::vector<std::string>& files,
                                               const Task& task) {
  std::vector<DetectionRecord> all;
  std::set<std::string> known;
  for (const std::string& file : files) {
    FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(file));
    FORESIGHT_TRY(const std::set<std::string> of_side_results, DetectionsOfSideResults(*mission));
    known.insert(of_side_results.begin(), of_side_results.end());
    FORESIGHT_TRY(const std::vector<DetectionRecord> records, mission->ListDetections());
    for (const DetectionRecord& record : records)
      if (record.scan_uuid == task.uuid && known.insert(record.uuid).second) all.push_back(record);
  }
  return all;
}

std::string FileNameOf(const std::string& uuid) {
  std::string name;
  for (const char c : uuid) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       c == '-' || c == '_';
    name += plain ? c : '_';
  }
  return name + ".json";
}

Result<RunAgainAnswer> RunTask(const RunArguments& arguments, const RunAgainSettings& settings,
                               const Task& task, const RunContext& context) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(task.mission));
  FORESIGHT_TRY(const Scan scan, mission->LoadScan(task.scan_id));
  FORESIGHT_TRY(const std::vector<DetectionRecord> records, RecordsOf(arguments.files, task));
  FORESIGHT_TRY(const RunAgainAnswer answer, RunAgain(scan, records, settings, context));
  FORESIGHT_CHECK(WriteFileAtomically(std::filesystem::path(arguments.out) / FileNameOf(task.uuid),
                                      answer.json));
  if (arguments.keep.empty()) return answer;
  FORESIGHT_TRY(const auto review, MissionFile::OpenReviewOf(task.mission));
  FORESIGHT_CHECK(KeepSideResult(*review, arguments.keep, scan, settings, answer));
  FORESIGHT_CHECK(review->Close());
  return answer;
}

/// "valve.seed=5".
Status AddFitOption(const std::string& text, RunAgainSettings& settings) {
  const std::size_t dot = text.find('.'), equals = text.find('=');
  if (dot == std::string::npos || equals == std::string::npos || equals < dot)
    return Fail(ErrorCode::kInvalidOptions,
                "--fit-option '{}': give it as KIND.KEY=VALUE, valve.seed=5 for one", text);
  const std::string key = text.substr(dot + 1, equals - dot - 1);
  const auto kind = ObjectKindFromString(text.substr(0, dot));
  if (!kind)
    return Fail(ErrorCode::kInvalidOptions, "--fit-option '{}': {}", text, kind.error().message);
  const Option<FitOptions>* option = FindOption(FitOptionTable(*kind), key);
  if (option == nullptr)
    return Fail(ErrorCode::kInvalidOptions, "--fit-option '{}': a {}'s fit has no option '{}'",
                text, ToString(*kind), key);
  const auto value = ValueOfFlag(option->info, text.substr(equals + 1));
  if (!value)
    return Fail(ErrorCode::kInvalidOptions, "--fit-option '{}': {}", text, value.error().message);
  FORESIGHT_CHECK(CheckFitOption(*kind, key, *value));
  settings.fit[*kind][key] = *value;
  return {};
}

Result<RunAgainSettings> SettingsFrom(const RunArguments& arguments) {
  RunAgainSettings settings;
  FORESIGHT_TRY(settings.depth, DepthOptionsFrom(arguments.depth));
  if (!arguments.rig.empty()) {
    FORESIGHT_TRY(settings.rig, LoadSensorRig(arguments.rig));
  }
  for (const std::string& text : arguments.fit_options)
    FORESIGHT_CHECK(AddFitOption(text, settings));
  if (arguments.source.empty()) return settings;
  FORESIGHT_TRY(
      settings.source,
      FitSourceFromName(arguments.source == "depth" ? arguments.depth.method : arguments.source));
  return settings;
}

Result<ExitCode> Run(const RunArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const Part part, ParsePart(arguments.part));
  FORESIGHT_TRY(const RunAgainSettings settings, SettingsFrom(arguments));
  FORESIGHT_TRY(const std::vector<Task> tasks, TasksOf(arguments.files, arguments.scan));
  FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
  RunAgainAnswer sum;
  int scans = 0;
  auto failed = nlohmann::ordered_json::array();
  for (std::size_t i = part.which - 1; i < tasks.size(); i += part.of) {
    const auto all = static_cast<double>(tasks.size()), at = static_cast<double>(i);
    const auto answer =
        RunTask(arguments, settings, tasks[i], context.Part(at / all, (at + 1.0) / all));
    if (!answer) {
      const ErrorCode code = answer.error().code;
      if (code == ErrorCode::kCancelled || code == ErrorCode::kIo)
        return tl::unexpected(answer.error());
      // One bad scan must not cost the others of a night.
      PrintNote("{}, scan {}: {}", tasks[i].mission, tasks[i].scan_id, answer.error().message);
      failed.push_back({{"mission", tasks[i].mission},
                        {"scan_uuid", tasks[i].uuid},
                        {"reason", answer.error().message}});
      continue;
    }
    ++scans;
    sum.depth_maps += answer->depth_maps;
    sum.fits += answer->fits;
    sum.fits_without_object += answer->fits_without_object;
    sum.failures += answer->failures;
    PrintNote("{} of {}: scan {}: {} depth maps, {} fits", i + 1, tasks.size(), tasks[i].uuid,
              answer->depth_maps, answer->fits);
  }
  if (arguments.json)
    PrintJson({{"out", arguments.out},
               {"scans", scans},
               {"depth_maps", sum.depth_maps},
               {"fits", sum.fits},
               {"fits_without_object", sum.fits_without_object},
               {"failures", sum.failures},
               {"failed_scans", failed}});
  else
    PrintLine(
        fmt::format("{}: {} scans, {} depth maps, {} fits, {} fits without an object, {} "
                    "failures, {} scans that could not be read",
                    arguments.out, scans, sum.depth_maps, sum.fits, sum.fits_without_object,
                    sum.failures, failed.size()));
  return failed.empty() && sum.failures == 0 ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddMissionRunCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = mission.add_subcommand(
      "run", "Make the depth maps and fits of many missions again, with other settings");
  command->add_option("files", arguments->files, "Mission files and reviews of them")->required();
  command->add_option("-o,--out", arguments->out, "Folder for the results: a JSON file a scan")
      ->required();
  AddOption(*command, "--part", arguments->part,
            "Do the K-th of N parts only; all parts together give the same files");
  command->add_option("--rig", arguments->rig, "Rig file in place of each scan's own rig");
  command->add_option("--source", arguments->source,
                      "What is fitted to: raw, or depth (that of --method); without it, what each "
                      "record was fitted to");
  command->add_option("--fit-option", arguments->fit_options,
                      "Option of every fit of a kind, as KIND.KEY=VALUE with the keys of records: "
                      "valve.seed=5");
  command->add_option("--scan", arguments->scan, "The scan of this number alone");
  command->add_option("--keep", arguments->keep,
                      "Keep each scan's result under this name, too, in the review beside its "
                      "mission; the mission is not touched");
  AddDepthArguments(*command, arguments->depth);
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Run(*arguments, context); };
  });
}

}  // namespace foresight
