#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/common/exit_code.h"
#include "core/base/run_context.h"

namespace foresight {

/// Reads the command line into `app`'s options, then does the work, which an interrupt cancels.
/// Says on stderr, in one line that begins with the program's name, what was wrong.
/// @returns what the program exits with.
int RunProgram(const std::string& name, CLI::App& app, int argc, char** argv,
               const std::function<Result<ExitCode>(const RunContext&)>& work);

}  // namespace foresight
