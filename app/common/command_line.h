#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/base/result.h"

namespace foresight {

/// Reads the command line into `app`'s options. Fails with kInvalidOptions: what CLI11 refuses; a
/// command that is missing or unknown, with the one that was probably meant; a number that is not
/// finite. @returns what is to be printed in place of any work, for who asked for help or for the
/// version; else empty.
Result<std::string> ParseCommandLine(CLI::App& app, int argc, char** argv);

/// Whether the command line asks for JSON, also where it makes no sense.
bool AsksForJson(int argc, char** argv);

/// The files that the command line names and that are there, with commas between them: what a
/// failure was about that knows no place itself.
std::string FilesNamed(int argc, char** argv);

}  // namespace foresight
