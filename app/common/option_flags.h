#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "core/options/option.h"

namespace foresight {

/// What was typed for options of a table, by their flags.
using GivenFlags = std::map<std::string, std::string>;

/// Adds the flags of a table's options. Options that share a flag are one on the command line: the
/// value is for all of them that apply. A document's flag takes a file.
void AddOptionFlag(CLI::App& command, const OptionInfo& info, GivenFlags& given);

template <class T>
void AddOptionFlags(CLI::App& command, OptionTable<T> table, GivenFlags& given) {
  for (const Option<T>& option : table)
    if (!option.info.flag.empty()) AddOptionFlag(command, option.info, given);
}

/// The flags of a table, each once.
template <class T>
std::vector<std::string> FlagsOf(OptionTable<T> table) {
  std::vector<std::string> flags;
  for (const Option<T>& option : table)
    if (!option.info.flag.empty() &&
        std::find(flags.begin(), flags.end(), option.info.flag) == flags.end())
      flags.push_back(option.info.flag);
  return flags;
}

/// The value that was typed; of a document, what its file holds. Fails with kInvalidOptions, and as
/// ReadFile does.
Result<OptionValue> ValueOfFlag(const OptionInfo& info, const std::string& text);

/// Names the flag, and the file of a document.
Error AtFlag(const OptionInfo& info, const std::string& text, const Error& error);

/// Sets what was given, in the table's order. Fails where nothing with that flag applies
/// ("--weights: method 'tgv' has no such option" with `of_what` "method 'tgv'"), and as SetOption
/// does.
template <class T>
Status ApplyFlags(OptionTable<T> table, const GivenFlags& given, const std::string& of_what,
                  T& options) {
  for (const auto& [flag, text] : given) {
    const auto takes = [&](const Option<T>& option) {
      return option.info.flag == flag && option.AppliesTo(options);
    };
    if (std::none_of(table.begin(), table.end(), takes))
      return Fail(ErrorCode::kInvalidOptions, "{}: {} has no such option", flag, of_what);
  }
  for (const Option<T>& option : table) {
    const auto at = given.find(option.info.flag);
    if (option.info.flag.empty() || at == given.end() || !option.AppliesTo(options)) continue;
    const Status set = ValueOfFlag(option.info, at->second).and_then([&](const OptionValue& value) {
      return SetOption(option, options, value);
    });
    if (!set) return tl::unexpected(AtFlag(option.info, at->second, set.error()));
  }
  return {};
}

}  // namespace foresight
