#include "app/common/run_program.h"

#include <fmt/format.h>

#include <cstdio>
#include <stop_token>

#include "app/common/interrupt_watcher.h"

namespace foresight {

int RunProgram(const std::string& name, CLI::App& app, int argc, char** argv,
               const std::function<Result<ExitCode>(const RunContext&)>& work) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == 0;
    if (asked_for_help) return app.exit(error);
    fmt::print(stderr, "{}: {} (--help shows how)\n", name, error.what());
    return static_cast<int>(ExitCode::kUsage);
  }

  std::stop_source stop;
  const InterruptWatcher watcher(stop);
  RunContext context;
  context.stop = stop.get_token();
  const auto result = work(context);
  if (result) return static_cast<int>(*result);
  fmt::print(stderr, "{}: {}\n", name, result.error().message);
  return static_cast<int>(ExitCodeFor(result.error().code));
}

}  // namespace foresight
