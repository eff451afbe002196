#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace foresight {

/// Adds an option whose value is a seed: a whole number from 0 to 2^64 - 1. A sign is refused, not
/// wrapped around.
CLI::Option* AddSeedOption(CLI::App& command, const char* name, std::uint64_t& seed,
                           const char* help);

}  // namespace foresight
