#include "core/base/operator_text.h"

#include <atomic>

namespace foresight {
namespace {

std::atomic<Translator> translator = nullptr;

}  // namespace

void SetTranslator(Translator wanted) {
  translator = wanted;
}

std::string OperatorText(const char* english) {
  const Translator look_up = translator;
  return look_up != nullptr ? look_up(english) : std::string(english);
}

std::string FormatOperatorText(const std::string& english, fmt::format_args arguments) {
  try {
    return fmt::vformat(OperatorText(english.c_str()), arguments);
  } catch (const fmt::format_error&) {
    return fmt::vformat(english, arguments);
  }
}

}  // namespace foresight
