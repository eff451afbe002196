// foresightctl: everything the workstation can do, without a window.
#include <cstdio>
#include <exception>
#include <stop_token>

#include "app/common/interrupt_watcher.h"
#include "app/ctl/command.h"

namespace foresight {
namespace {

int Main(int argc, char** argv) {
  CLI::App app{"foresightctl: scan, depth, fits and evaluation without the workstation"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "foresightctl " FORESIGHT_VERSION);
  Invocation invocation;
  AddScanCommand(app, invocation);
  AddDepthCommand(app, invocation);
  AddFitCommand(app, invocation);
  AddUpsampleCommand(app, invocation);
  AddEvaluateCommand(app, invocation);
  AddRenderCommand(app, invocation);
  AddDemoCommand(app, invocation);
  AddEmulateCommand(app, invocation);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == 0;
    if (asked_for_help) return app.exit(error);
    fmt::print(stderr, "foresightctl: {} (--help shows how)\n", error.what());
    return static_cast<int>(ExitCode::kUsage);
  }

  std::stop_source stop;
  const InterruptWatcher watcher(stop);
  RunContext context;
  context.stop = stop.get_token();
  const auto result = invocation(context);
  if (result) return static_cast<int>(*result);
  fmt::print(stderr, "foresightctl: {}\n", result.error().message);
  return static_cast<int>(ExitCodeFor(result.error().code));
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  try {
    return foresight::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "foresightctl: internal error: {}\n", error.what());
    return static_cast<int>(foresight::ExitCode::kBadData);
  }
}
