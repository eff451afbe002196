#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/common/exit_code.h"
#include "core/base/run_context.h"

namespace foresight {

/// Reads the command line into `app`'s options, then does the work, which an interrupt cancels.
/// Says on stderr, in one line that begins with the program's name, what was wrong; with --json
/// also on stdout, as JSON (ErrorReporter). What cannot be printed, a disk that is full and memory
/// that does not suffice are errors like others.
/// @returns what the program exits with.
int RunProgram(const std::string& name, CLI::App& app, int argc, char** argv,
               const std::function<Result<ExitCode>(const RunContext&)>& work);

}  // namespace foresight
