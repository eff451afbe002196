#include <memory>

#include "app/ctl/command.h"
#include "app/ctl/open_scan.h"
#include "core/registration/export_cloud.h"

namespace foresight {
namespace {

struct CloudArguments {
  ScanArguments scan;
  std::string out;
  bool json = false;
};

Result<ExitCode> Cloud(const CloudArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const OpenedScan opened, OpenScanWithoutImage(arguments.scan));
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(opened.scan, context));
  FORESIGHT_TRY(const std::size_t points, ExportCloud(cloud, opened.scan, arguments.out));
  if (arguments.json)
    PrintJson({{"scan", opened.id},
               {"uuid", opened.scan.uuid},
               {"frame", "robot"},
               {"points", points},
               {"out", arguments.out}});
  else
    PrintLine(fmt::format("{}: {} points of scan {} in the robot's frame, metres", arguments.out,
                          points, opened.id));
  return ExitCode::kDone;
}

}  // namespace

void AddCloudCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<CloudArguments>();
  CLI::App* command =
      app.add_subcommand("cloud", "Write a scan's points in the robot's frame as PLY or PCD");
  AddMissionArguments(*command, arguments->scan);
  command
      ->add_option("-o,--out", arguments->out,
                   "File for the points: PCD where its name ends in .pcd, else PLY")
      ->required();
  command->add_flag("--json", arguments->json, "Print the summary as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return Cloud(*arguments, context); };
  });
}

}  // namespace foresight
