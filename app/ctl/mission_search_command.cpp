#include <ctime>
#include <memory>
#include <optional>

#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/mission/mission_index.h"

namespace foresight {

void AddMissionSearchCommand(CLI::App& mission, Invocation& invocation);

namespace {

struct SearchArguments {
  std::string folder;
  MissionQuery query;
  std::string since;
  std::string until;
  bool json = false;
};

/// Nanoseconds since 1970 of "2026-11-22" or "2026-11-22T13:06:33".
Result<std::optional<std::int64_t>> TimeFrom(const char* flag, const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::tm time{};
  const char* rest = ::strptime(text.c_str(), "%Y-%m-%d", &time);
  if (rest != nullptr && *rest == 'T') rest = ::strptime(rest, "T%H:%M:%S", &time);
  if (rest != nullptr && *rest == 'Z') ++rest;
  if (rest == nullptr || *rest != '\0')
    return Fail(ErrorCode::kInvalidOptions,
                "{} '{}': give it as 2026-11-22 or 2026-11-22T13:06:33, UTC", flag, text);
  return std::int64_t{1'000'000'000} * ::timegm(&time);
}

Result<ExitCode> Search(SearchArguments arguments, const RunContext& context) {
  FORESIGHT_TRY(arguments.query.since_utc_ns, TimeFrom("--since", arguments.since));
  FORESIGHT_TRY(arguments.query.until_utc_ns, TimeFrom("--until", arguments.until));
  FORESIGHT_TRY(const MissionHits found,
                SearchMissions(arguments.folder, arguments.query, IndexCacheFolder(), context));
  for (const std::string& line : found.unreadable) PrintNote("not searched: {}", line);
  auto list = nlohmann::ordered_json::array();
  std::string text;
  for (const MissionHit& hit : found.hits) {
    list.push_back({{"mission", hit.mission.string()},
                    {"what", hit.what},
                    {"scan", hit.scan},
                    {"scan_uuid", hit.scan_uuid},
                    {"utc", UtcText(hit.utc_ns)},
                    {"text", hit.text}});
    text += fmt::format("{}  {:<6}  {}  {}\n", UtcText(hit.utc_ns), hit.what, hit.mission.string(),
                        hit.text);
  }
  if (arguments.json)
    PrintJson({{"folder", arguments.folder},
               {"missions", found.missions},
               {"read_again", found.read_again},
               {"hits", list},
               {"unreadable", found.unreadable}});
  else
    PrintLine(text + fmt::format("{} found in {} missions", found.hits.size(), found.missions));
  return found.hits.empty() ? ExitCode::kNegative : ExitCode::kDone;
}

}  // namespace

void AddMissionSearchCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<SearchArguments>();
  MissionQuery& query = arguments->query;
  CLI::App* command = mission.add_subcommand(
      "search", "Find scans, objects, notes and lines of the log in all missions of a folder");
  command->add_option("folder", arguments->folder, "Folder; missions below it count too")
      ->required();
  command->add_option("words", query.words,
                      "Words that all must be there: drill, interrupted, ...");
  command->add_option("--what", query.what, "Only one sort of entry")
      ->check(CLI::IsMember({"scan", "object", "note", "log"}));
  command->add_option("--kind", query.kind,
                      "Only this kind: valve, drill, terrain, handle, cylinder, note, measurement");
  command->add_option("--decision", query.decision, "Only objects with this decision")
      ->check(CLI::IsMember({"open", "accepted", "rejected"}));
  command->add_option("--since", arguments->since, "Not before this time, UTC");
  command->add_option("--until", arguments->until, "Before this time, UTC");
  AddOption(*command, "--limit", query.at_most, "At most so many, the newest first");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Search(*arguments, context); };
  });
}

}  // namespace foresight
