#include "app/common/option_flags.h"

#include "core/base/atomic_file.h"
#include "core/options/option_text.h"

namespace foresight {
namespace {

/// Empty, or what is wrong with the text. Its range depends on the option that takes it, and what a
/// file holds is looked at later.
std::string CheckText(const OptionInfo& info, const std::string& text) {
  if (info.type == OptionType::kDocument) return {};
  const auto value = OptionFromText(info, text);
  if (!value) return value.error().message;
  const Status sound = info.type == OptionType::kChoice ? CheckOption(info, *value) : Status();
  return sound ? std::string() : fmt::format("'{}' is not {}", text, RangeText(info));
}

std::string TypeName(const OptionInfo& info) {
  switch (info.type) {
    case OptionType::kInteger:
      return "INT";
    case OptionType::kSeed:
      return "seed";
    case OptionType::kSwitch:
      return "on|off";
    case OptionType::kNumbers:
      return fmt::format("{} x FLOAT", info.count);
    case OptionType::kChoice: {
      std::string words;
      for (const std::string& word : info.words) words += (words.empty() ? "" : "|") + word;
      return words;
    }
    case OptionType::kDocument:
      return "FILE";
    case OptionType::kNumber:
      break;
  }
  return "FLOAT";
}

}  // namespace

void AddOptionFlag(CLI::App& command, const OptionInfo& info, GivenFlags& given) {
  if (command.get_option_no_throw(info.flag) != nullptr) return;
  command
      .add_option_function<std::string>(
          info.flag, [&given, flag = info.flag](const std::string& text) { given[flag] = text; },
          info.help)
      ->type_name(TypeName(info))
      ->check(CLI::Validator([info](std::string& text) { return CheckText(info, text); }, ""));
}

Result<OptionValue> ValueOfFlag(const OptionInfo& info, const std::string& text) {
  if (info.type != OptionType::kDocument) return OptionFromText(info, text);
  FORESIGHT_TRY(std::string document, ReadFile(text));
  if (document.empty()) return Fail(ErrorCode::kBadData, "is empty");
  return document;
}

Error AtFlag(const OptionInfo& info, const std::string& text, const Error& error) {
  if (info.type != OptionType::kDocument)
    return {error.code, fmt::format("{}: {}", info.flag, error.message)};
  if (error.message.find(text) != std::string::npos) return error;
  return {error.code, fmt::format("{}: {}", text, error.message)};
}

}  // namespace foresight
