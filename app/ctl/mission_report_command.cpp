#include <memory>

#include "app/ctl/command.h"
#include "core/report/mission_report.h"

namespace foresight {
namespace {

struct ReportArguments {
  std::string file;
  MissionReportOptions options;
  std::string out;
  bool json = false;
};

Result<ExitCode> Report(const ReportArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const auto mission, MissionFile::OpenReadOnly(arguments.file));
  FORESIGHT_TRY(const auto review, MissionFile::FindReviewOf(arguments.file));
  FORESIGHT_CHECK(MakeOutputFolder(arguments.out));
  FORESIGHT_TRY(
      const MissionReportFiles files,
      WriteMissionReport(*mission, review.get(), arguments.out, arguments.options, context));
  for (const std::string& left_out : files.left_out) PrintNote("left out: {}", left_out);
  if (arguments.json)
    PrintJson({{"mission", arguments.file},
               {"out", arguments.out},
               {"scans", files.scans},
               {"objects", files.objects},
               {"files", files.files},
               {"left_out", files.left_out}});
  else
    PrintLine(fmt::format("{}: {} scans, {} objects, {} files; begin with report.html",
                          arguments.out, files.scans, files.objects, files.files.size()));
  return files.left_out.empty() ? ExitCode::kDone : ExitCode::kNegative;
}

}  // namespace

void AddMissionReportCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = mission.add_subcommand(
      "report", "A page with pictures of a mission or of one scan, to read, print and file");
  command->add_option("file", arguments->file, "Mission file")->required();
  command->add_option("--scan", arguments->options.scan, "Of one scan, by its number");
  command->add_option("-o,--out", arguments->out, "Folder for report.html and its pictures")
      ->required();
  command->add_flag("--pdf", arguments->options.pdf, "Also write report.pdf");
  command->add_flag("--json", arguments->json, "Print what was written as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Report(*arguments, context); };
  });
}

}  // namespace foresight
