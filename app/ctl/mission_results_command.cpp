#include <memory>

#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/mission/side_result.h"

namespace foresight {
namespace {

struct ResultsArguments {
  std::string file;
  std::optional<std::int64_t> scan;
  bool json = false;
};

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "; ") + word;
  return text.empty() ? "the original's settings" : text;
}

Result<ExitCode> Results(const ResultsArguments& arguments) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(arguments.file));
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission->ListScans());
  auto list = nlohmann::ordered_json::array();
  std::string text = fmt::format("{:>4}  {:<20}  {:<24}  {:<12}  {}", "scan", "name", "time (UTC)",
                                 "author", "what differs");
  bool known = !arguments.scan;
  for (const ScanSummary& scan : scans) {
    if (arguments.scan && scan.id != *arguments.scan) continue;
    known = true;
    FORESIGHT_TRY(const Scan header, mission->LoadHeader(scan.id));
    FORESIGHT_TRY(const DepthOptions original, OriginalDepthOptions(*mission, scan.id, -1));
    for (const MissionFile* file : {mission.get(), review.get()}) {
      if (file == nullptr) continue;
      FORESIGHT_TRY(const std::vector<SideResult> results, ListSideResults(*file, scan.uuid));
      for (const SideResult& result : results) {
        const std::vector<std::string> words = DifferencesInWords(result, original, header.rig);
        list.push_back({{"scan", scan.id},
                        {"scan_uuid", scan.uuid},
                        {"uuid", result.uuid},
                        {"name", result.name},
                        {"author", result.author},
                        {"utc", UtcText(result.utc_ns)},
                        {"differences", words},
                        {"answer", nlohmann::ordered_json::parse(result.answer_json)}});
        text += fmt::format("\n{:>4}  {:<20}  {:<24}  {:<12}  {}", scan.id, result.name,
                            UtcText(result.utc_ns), result.author, Joined(words));
      }
    }
  }
  if (!known)
    return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", arguments.file,
                *arguments.scan);
  if (arguments.json)
    PrintJson({{"mission", arguments.file}, {"results", list}});
  else
    PrintLine(list.empty() ? "no side results" : text);
  return ExitCode::kDone;
}

}  // namespace

void AddMissionResultsCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<ResultsArguments>();
  CLI::App* command = mission.add_subcommand(
      "results", "The side results of a mission: what was made again with other settings");
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_option("--scan", arguments->scan, "Of one scan, by its number");
  command->add_flag("--json", arguments->json, "Print as JSON, with the results themselves");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return Results(*arguments); };
  });
}

}  // namespace foresight
