#include "core/options/option_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

namespace foresight {
namespace {

constexpr double kNoLow = std::numeric_limits<double>::lowest();
constexpr double kNoHigh = std::numeric_limits<double>::max();

template <class T>
bool Parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// The shortest text that is typed for a number: reading it gives the number again.
std::string NumberText(const OptionInfo& info, double value) {
  const double typed = value * info.units_per_si;
  for (int digits = 6; digits < 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", typed, digits);
    double read = 0.0;
    if (Parse(text, read) && read / info.units_per_si == value) return text;
  }
  return fmt::format("{:.17g}", typed);
}

Result<OptionValue> Refuse(const OptionInfo& info, const std::string& text) {
  return Fail(ErrorCode::kInvalidOptions, "'{}' is no {}", text, TypeText(info));
}

Result<OptionValue> NumbersFrom(const OptionInfo& info, const std::string& text) {
  std::vector<double> numbers;
  std::string_view rest = text;
  while (numbers.size() < static_cast<std::size_t>(info.count)) {
    const std::size_t comma = rest.find(',');
    double number = 0.0;
    if (!Parse(rest.substr(0, comma), number)) return Refuse(info, text);
    numbers.push_back(number / info.units_per_si);
    if (comma == std::string_view::npos) {
      rest = {};
      break;
    }
    rest.remove_prefix(comma + 1);
  }
  if (!rest.empty() || numbers.size() != static_cast<std::size_t>(info.count))
    return Refuse(info, text);
  return numbers;
}

std::string WithUnit(double typed, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", typed) : fmt::format("{} {}", typed, unit);
}

}  // namespace

std::string OptionText(const OptionInfo& info, const OptionValue& value) {
  struct Writer {
    const OptionInfo& info;
    std::string operator()(bool on) const { return on ? "on" : "off"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(std::uint64_t seed) const { return fmt::format("{}", seed); }
    std::string operator()(double number) const { return NumberText(info, number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const std::vector<double>& numbers) const {
      std::string text;
      for (double number : numbers) text += (text.empty() ? "" : ",") + NumberText(info, number);
      return text;
    }
  };
  return std::visit(Writer{info}, value);
}

std::string OptionInWords(const OptionInfo& info, const OptionValue& value) {
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && *number == 0.0 && !info.automatic.empty()) return info.automatic;
  const std::string text = OptionText(info, value);
  return info.unit.empty() ? text : text + " " + info.unit;
}

Result<OptionValue> OptionFromText(const OptionInfo& info, const std::string& text) {
  switch (info.type) {
    case OptionType::kNumber: {
      double number = 0.0;
      if (!Parse(text, number) || !std::isfinite(number)) return Refuse(info, text);
      return number / info.units_per_si;
    }
    case OptionType::kInteger: {
      std::int64_t integer = 0;
      if (!Parse(text, integer)) return Refuse(info, text);
      return integer;
    }
    case OptionType::kSeed: {
      std::uint64_t seed = 0;
      if (!Parse(text, seed)) return Refuse(info, text);
      return seed;
    }
    case OptionType::kSwitch:
      if (text != "on" && text != "off") return Refuse(info, text);
      return text == "on";
    case OptionType::kNumbers:
      return NumbersFrom(info, text);
    case OptionType::kChoice:
    case OptionType::kDocument:
      break;
  }
  return text;
}

std::string TypeText(const OptionInfo& info) {
  switch (info.type) {
    case OptionType::kNumber:
      return "number";
    case OptionType::kInteger:
      return "whole number";
    case OptionType::kSeed:
      return fmt::format("seed: a whole number from 0 to {}",
                         std::numeric_limits<std::uint64_t>::max());
    case OptionType::kSwitch:
      return "switch: on or off";
    case OptionType::kNumbers:
      return fmt::format("list of {} numbers with commas between them", info.count);
    case OptionType::kChoice:
      return fmt::format("choice: {}", RangeText(info));
    case OptionType::kDocument:
      break;
  }
  return "text";
}

std::string RangeText(const OptionInfo& info) {
  if (info.type == OptionType::kChoice)
    return fmt::format("one of {}", fmt::join(info.words, ", "));
  if (info.low == kNoLow && info.high == kNoHigh) return "a number";
  if (info.high == kNoHigh) return WithUnit(info.low, info.unit) + " or more";
  if (info.low == kNoLow) return WithUnit(info.high, info.unit) + " or less";
  return fmt::format("from {} to {}", info.low, WithUnit(info.high, info.unit));
}

}  // namespace foresight
