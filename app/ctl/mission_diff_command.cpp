#include <memory>

#include "app/ctl/command.h"
#include "core/mission/diff_missions.h"

namespace foresight {
namespace {

struct DiffArguments {
  std::string first;
  std::string second;
  bool json = false;
};

Result<ExitCode> Diff(const DiffArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const auto first, MissionFile::OpenReadOnly(arguments.first));
  FORESIGHT_TRY(const auto second, MissionFile::OpenReadOnly(arguments.second));
  FORESIGHT_TRY(const std::vector<MissionDifference> differences,
                DiffMissions(*first, *second, context));
  auto list = nlohmann::ordered_json::array();
  std::string text;
  for (const MissionDifference& difference : differences) {
    list.push_back({{"kind", ToString(difference.kind)},
                    {"what", difference.what},
                    {"uuid", difference.uuid},
                    {"text", difference.text}});
    text +=
        fmt::format("{} {}: {}{}{}\n", difference.what, difference.uuid, ToString(difference.kind),
                    difference.text.empty() ? "" : ": ", difference.text);
  }
  if (arguments.json)
    PrintJson({{"first", arguments.first},
               {"second", arguments.second},
               {"same", differences.empty()},
               {"differences", list}});
  else
    PrintLine(differences.empty() ? "both hold the same"
                                  : text + fmt::format("{} differences", differences.size()));
  return differences.empty() ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddMissionDiffCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<DiffArguments>();
  CLI::App* command = mission.add_subcommand(
      "diff", "In what two missions differ: scans, detections, depth maps, log");
  command->add_option("first", arguments->first, "Mission file")->required();
  command->add_option("second", arguments->second, "Mission file")->required();
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Diff(*arguments, context); };
  });
}

}  // namespace foresight
