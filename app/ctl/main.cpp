// foresightctl: everything the workstation can do, without a window.
#include <exception>

#include "app/common/run_program.h"
#include "app/ctl/command.h"
#include "core/base/version.h"

namespace foresight {

namespace {

int Main(int argc, char** argv) {
  CLI::App app{"foresightctl: scan, depth, fits and evaluation without the workstation"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("foresightctl ") + ProgramVersion());
  Invocation invocation;
  AddScanCommand(app, invocation);
  AddDepthCommand(app, invocation);
  AddCloudCommand(app, invocation);
  AddFitCommand(app, invocation);
  AddCheckCommand(app, invocation);
  AddUpsampleCommand(app, invocation);
  AddEvaluateCommand(app, invocation);
  AddEvaluateFitsCommand(app, invocation);
  AddEvaluateBoardsCommand(app, invocation);
  AddEvaluateConfidenceCommand(app, invocation);
  AddEvaluateOutlinesCommand(app, invocation);
  AddEvaluateCheckCommand(app, invocation);
  AddVerdictCommand(app, invocation);
  AddRenderCommand(app, invocation);
  AddDemoCommand(app, invocation);
  AddEmulateCommand(app, invocation);
  AddHealthCommand(app, invocation);
  AddFetchCommand(app, invocation);
  AddImageCommand(app, invocation);
  AddStopCommand(app, invocation);
  AddHeadsCommand(app, invocation);
  AddMapCommand(app, invocation);
  AddMissionCommand(app, invocation);
  AddBundleCommand(app, invocation);
  AddRigCommand(app, invocation);
  AddPkiCommand(app, invocation);
  AddCalibrateCommand(app, invocation);
  AddTargetCommand(app, invocation);
  AddSimulateCommand(app, invocation);
  return RunProgram("foresightctl", app, argc, argv,
                    [&](const RunContext& context) { return invocation(context); });
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  try {
    return foresight::Main(argc, argv);
  } catch (const std::exception& error) {
    foresight::PrintNote("foresightctl: internal error: {}", error.what());
    return static_cast<int>(foresight::ExitCode::kBadData);
  }
}
