// foresightctl: everything the workstation can do, without a window.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stop_token>
#include <thread>

#include "app/ctl/command.h"

namespace foresight {
namespace {

std::atomic<bool> g_interrupted{false};

/// Ctrl-C asks the running command to stop; it ends tidily and leaves nothing half written.
class InterruptWatcher {
 public:
  explicit InterruptWatcher(std::stop_source& source) {
    std::signal(SIGINT, [](int) { g_interrupted = true; });
    std::signal(SIGTERM, [](int) { g_interrupted = true; });
    thread_ = std::jthread([&source](std::stop_token ended) {
      while (!ended.stop_requested()) {
        if (g_interrupted) source.request_stop();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    });
  }

 private:
  std::jthread thread_;
};

ExitCode ExitCodeFor(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidOptions:
      return ExitCode::kUsage;
    case ErrorCode::kTooFewPoints:
    case ErrorCode::kNoConvergence:
      return ExitCode::kNegative;
    default:
      return ExitCode::kBadData;
  }
}

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
