#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// What a program tells its caller by its exit code.
enum class ExitCode : int {
  kDone = 0,      ///< done, with a positive result where there is one
  kNegative = 1,  ///< done, but: no object, bad quality
  kUsage = 2,     ///< the command line makes no sense
  kBadData = 3,   ///< a file or a device failed
};

/// The one subcommand that the command line chose, ready to run.
using Invocation = std::function<Result<ExitCode>(const RunContext&)>;

/// Adds a subcommand and its options to `app`; when it is chosen, parsing fills `invocation`.
void AddScanCommand(CLI::App& app, Invocation& invocation);
void AddDepthCommand(CLI::App& app, Invocation& invocation);
void AddFitCommand(CLI::App& app, Invocation& invocation);
void AddEvaluateCommand(CLI::App& app, Invocation& invocation);
void AddUpsampleCommand(CLI::App& app, Invocation& invocation);
void AddRenderCommand(CLI::App& app, Invocation& invocation);
void AddDemoCommand(CLI::App& app, Invocation& invocation);

/// Creates the folder for results. Fails with kIo.
Status MakeOutputFolder(const std::string& folder);

/// Results go to standard output, all of it in one piece.
void PrintJson(const nlohmann::ordered_json& json);
void PrintLine(const std::string& line);

/// A number for JSON: null where it is not finite.
nlohmann::ordered_json Finite(double value);

}  // namespace foresight
