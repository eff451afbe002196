#include "core/options/option.h"

#include <algorithm>
#include <cmath>

#include "core/options/option_text.h"

namespace foresight {
namespace {

bool HasTypeOf(const OptionInfo& info, const OptionValue& value) {
  switch (info.type) {
    case OptionType::kNumber:
      return std::holds_alternative<double>(value);
    case OptionType::kInteger:
      return std::holds_alternative<std::int64_t>(value);
    case OptionType::kSeed:
      return std::holds_alternative<std::uint64_t>(value);
    case OptionType::kSwitch:
      return std::holds_alternative<bool>(value);
    case OptionType::kNumbers:
      return std::holds_alternative<std::vector<double>>(value) &&
             std::get<std::vector<double>>(value).size() == static_cast<std::size_t>(info.count);
    case OptionType::kChoice:
    case OptionType::kDocument:
      return std::holds_alternative<std::string>(value);
  }
  return false;
}

/// `value` as the options keep it. Half a rounding is allowed: a limit is typed in another unit.
bool InRange(const OptionInfo& info, double value) {
  const double typed = value * info.units_per_si;
  const double slack = 1e-12 * std::abs(typed);
  return std::isfinite(value) && typed >= info.low - slack && typed <= info.high + slack;
}

bool InRange(const OptionInfo& info, const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return InRange(info, *number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    constexpr auto kMost = std::numeric_limits<int>::max();
    return *integer >= -kMost && *integer <= kMost && InRange(info, static_cast<double>(*integer));
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    return std::all_of(numbers->begin(), numbers->end(),
                       [&](double number) { return InRange(info, number); });
  if (const auto* word = std::get_if<std::string>(&value); info.type == OptionType::kChoice)
    return std::find(info.words.begin(), info.words.end(), *word) != info.words.end();
  return true;
}

}  // namespace

Status CheckOption(const OptionInfo& info, const OptionValue& value) {
  if (!HasTypeOf(info, value))
    return Fail(ErrorCode::kInvalidOptions, "{} is no {}", info.key, TypeText(info));
  if (!InRange(info, value))
    return Fail(ErrorCode::kInvalidOptions, "{} is {}; it must be {}", info.key,
                OptionText(info, value), RangeText(info));
  return {};
}

}  // namespace foresight
