#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "app/ctl/late/late_command.h"
#include "core/exchange/export_mission.h"

namespace foresight {
namespace {

struct ExportArguments {
  std::string file;
  std::string out;
  std::vector<std::string> what = {"ply", "images", "depth-png", "camera", "tables"};
  std::vector<std::int64_t> scans;
  DepthArguments depth;
  bool json = false;
};

std::string AllParts() {
  std::string names;
  for (const ExportPart part : kExportParts)
    names += (names.empty() ? "" : ", ") + std::string(ToString(part));
  return names;
}

Result<MissionExportOptions> OptionsFrom(const ExportArguments& arguments) {
  MissionExportOptions options;
  options.scans = arguments.scans;
  FORESIGHT_TRY(options.depth, DepthOptionsFrom(arguments.depth));
  if (arguments.what == std::vector<std::string>{"all"}) return options;
  options.parts.clear();
  for (const std::string& name : arguments.what) {
    FORESIGHT_TRY(const ExportPart part, ExportPartFromText(name));
    options.parts.push_back(part);
  }
  return options;
}

Result<ExitCode> Export(const ExportArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const MissionExportOptions options, OptionsFrom(arguments));
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const MissionExportReport report,
                ExportMission(*mission, arguments.out, options, context));
  for (const std::string& sentence : report.left_out) PrintNote("left out: {}", sentence);
  if (arguments.json) {
    auto files = nlohmann::ordered_json::array();
    for (const std::filesystem::path& file : report.files) files.push_back(file.string());
    PrintJson({{"mission", arguments.file},
               {"out", arguments.out},
               {"files", files},
               {"left_out", report.left_out}});
  } else {
    std::string text;
    for (const std::filesystem::path& file : report.files) text += file.string() + "\n";
    PrintLine(text + fmt::format("{}: {} files", arguments.out, report.files.size()));
  }
  return report.left_out.empty() ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

extern "C" void AddMissionExportOptions(CLI::App* command, Invocation* invocation) {
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_option("-o,--out", arguments->out, "Folder for the files")->required();
  AddOption(*command, "--what", arguments->what, ("all, or some of " + AllParts()).c_str())
      ->delimiter(',');
  command->add_option("--scan", arguments->scans, "Only these scans")->delimiter(',');
  AddDepthArguments(*command, arguments->depth);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([invocation, arguments] {
    *invocation = [arguments](const RunContext& context) { return Export(*arguments, context); };
  });
}

}  // namespace foresight
