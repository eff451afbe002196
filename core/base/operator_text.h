#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace foresight {

/// Looks up an operator's text in the language of the program; nullptr = as it stands, English.
/// Set once, before other threads begin: the workstation gives Qt's translation.
using Translator = std::string (*)(const char* english);
void SetTranslator(Translator translator);

/// A text that an operator reads, in the language of the program. Records and what programs read
/// (JSON) stay English. lupdate finds the texts by this name (-tr-function-alias).
std::string OperatorText(const char* english);

/// A translated format that does not fit the arguments counts as none.
std::string FormatOperatorText(const std::string& english, fmt::format_args arguments);

/// The same of a format, which is translated as a whole.
template <class... Args>
std::string OperatorText(fmt::format_string<Args...> english,
                         Args&&... args) requires(sizeof...(Args) > 0) {
  return FormatOperatorText(
      std::string(fmt::string_view(english).data(), fmt::string_view(english).size()),
      fmt::make_format_args(args...));
}

}  // namespace foresight
