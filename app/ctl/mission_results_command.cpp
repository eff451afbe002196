#include <memory>

#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/mission/side_result.h"

namespace foresight {
namespace {

struct ResultsArguments {
  std::string file;
  std::optional<std::int64_t> scan;
  std::string rename;
  std::string to;
  std::string remove;
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
    FORESIGHT_TRY(const std::vector<SideResult> results,
                  SideResultsOf(*mission, review.get(), scan.uuid));
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
  if (!known)
    return Fail(ErrorCode::kInvalidInput, "{}: there is no scan {}", arguments.file,
                *arguments.scan);
  if (arguments.json)
    PrintJson({{"mission", arguments.file}, {"results", list}});
  else
    PrintLine(list.empty() ? "no side results" : text);
  return ExitCode::kDone;
}

/// The side result of this uuid, this beginning of it, or this name.
Result<SideResult> ResultNamed(const ResultsArguments& arguments, const std::string& wanted) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(arguments.file));
  std::string scan_uuid;
  if (arguments.scan) {
    FORESIGHT_TRY(const ScanSummary scan, mission->Summary(*arguments.scan));
    scan_uuid = scan.uuid;
  }
  FORESIGHT_TRY(const std::vector<SideResult> all,
                SideResultsOf(*mission, review.get(), scan_uuid));
  std::optional<SideResult> found;
  for (const SideResult& result : all) {
    if (result.name != wanted && !result.uuid.starts_with(wanted)) continue;
    if (found)
      return Fail(ErrorCode::kInvalidInput,
                  "{}: more than one side result is '{}'; name it by its uuid", arguments.file,
                  wanted);
    found = result;
  }
  if (!found)
    return Fail(ErrorCode::kInvalidInput, "{}: there is no side result '{}'", arguments.file,
                wanted);
  return *found;
}

Result<ExitCode> ChangeResult(const ResultsArguments& arguments) {
  const bool removes = !arguments.remove.empty();
  if (!removes && arguments.to.empty())
    return Fail(ErrorCode::kInvalidOptions, "--rename needs --to NAME");
  FORESIGHT_TRY(const SideResult result,
                ResultNamed(arguments, removes ? arguments.remove : arguments.rename));
  FORESIGHT_TRY(const auto review, MissionFile::OpenReviewOf(arguments.file));
  FORESIGHT_CHECK(removes ? DeleteSideResult(*review, result.uuid)
                          : RenameSideResult(*review, result.uuid, arguments.to));
  FORESIGHT_CHECK(review->Close());
  const std::string& name = removes ? result.name : arguments.to;
  if (arguments.json)
    PrintJson(
        {{"mission", arguments.file}, {"uuid", result.uuid}, {"name", name}, {"deleted", removes}});
  else
    PrintLine(fmt::format("{} {} {}", removes ? "deleted" : "renamed", result.uuid, name));
  return ExitCode::kDone;
}

}  // namespace

void AddMissionResultsCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<ResultsArguments>();
  CLI::App* command = mission.add_subcommand(
      "results", "The side results of a mission: what was made again with other settings");
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_option("--scan", arguments->scan, "Of one scan, by its number");
  auto* rename = command->add_option("--rename", arguments->rename,
                                     "Name or uuid of a side result that gets another name");
  rename->needs(command->add_option("--to", arguments->to, "The other name")->needs(rename));
  command
      ->add_option("--delete", arguments->remove,
                   "Name or uuid of a side result to take out of the lists; its records stay")
      ->excludes(rename);
  command->add_flag("--json", arguments->json, "Print as JSON, with the results themselves");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) {
      const bool changes = !arguments->rename.empty() || !arguments->remove.empty();
      return changes ? ChangeResult(*arguments) : Results(*arguments);
    };
  });
}

}  // namespace foresight
