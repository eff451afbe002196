#include "app/common/run_program.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <new>
#include <stdexcept>
#include <stop_token>
#include <string_view>

#include "app/common/command_line.h"
#include "app/common/interrupt_watcher.h"
#include "app/common/output.h"

namespace foresight {
namespace {

/// A stream that the caller closed would be the number of the next file that is opened, and results
/// would be printed into that file. What stands in for it refuses to be written.
void HoldStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// A reader that is gone and a file that may not grow are errors of a write, not the program's end.
void IgnoreWriteSignals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

ExitCode Reported(const ErrorReporter& reporter, const Error& error) {
  reporter.Report(error);
  return ExitCodeFor(error.code);
}

/// What a library or our own code throws. OpenCV has an exception of its own for memory.
Error ErrorOf(const std::exception& thrown, int argc, char** argv) {
  const bool memory =
      dynamic_cast<const std::bad_alloc*>(&thrown) != nullptr ||
      dynamic_cast<const std::length_error*>(&thrown) != nullptr ||
      std::string_view(thrown.what()).find("Insufficient memory") != std::string_view::npos;
  if (!memory) return {ErrorCode::kState, fmt::format("internal error: {}", thrown.what())};
  const std::string files = FilesNamed(argc, argv);
  return {ErrorCode::kIo, fmt::format("{}{}the work does not fit into memory: close other "
                                      "programs, or give it less to do",
                                      files, files.empty() ? "" : ": ")};
}

ExitCode Run(const ErrorReporter& reporter, CLI::App& app, int argc, char** argv,
             const std::function<Result<ExitCode>(const RunContext&)>& work) {
  const Result<std::string> text = ParseCommandLine(app, argc, argv);
  if (!text) return Reported(reporter, text.error());
  ExitCode code = ExitCode::kDone;
  if (!text->empty()) {
    PrintLine(text->substr(0, text->find_last_not_of('\n') + 1));
  } else {
    std::stop_source stop;
    const InterruptWatcher watcher(stop);
    RunContext context;
    context.stop = stop.get_token();
    const Result<ExitCode> result = work(context);
    if (!result) return Reported(reporter, result.error());
    code = *result;
  }
  if (const Status written = CheckOutput(); !written) return Reported(reporter, written.error());
  return code;
}

}  // namespace

int RunProgram(const std::string& name, CLI::App& app, int argc, char** argv,
               const std::function<Result<ExitCode>(const RunContext&)>& work) {
  HoldStandardStreams();
  IgnoreWriteSignals();
  const ErrorReporter reporter(name, AsksForJson(argc, argv));
  try {
    return static_cast<int>(Run(reporter, app, argc, argv, work));
  } catch (const std::exception& thrown) {
    reporter.Report(ErrorOf(thrown, argc, argv));
    return static_cast<int>(ExitCode::kBadData);
  }
}

}  // namespace foresight
