#include "app/common/seed_option.h"

#include <charconv>
#include <limits>
#include <string>

namespace foresight {
namespace {

/// Empty, or what is wrong with the text.
std::string CheckSeed(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return {};
  return "'" + text + "' is no seed: a whole number from 0 to " +
         std::to_string(std::numeric_limits<std::uint64_t>::max());
}

}  // namespace

CLI::Option* AddSeedOption(CLI::App& command, const char* name, std::uint64_t& seed,
                           const char* help) {
  return command.add_option(name, seed, help)->check(CLI::Validator(CheckSeed, "", "seed"));
}

}  // namespace foresight
