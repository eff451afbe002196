#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace foresight {

enum class OptionType {
  kNumber,    ///< double
  kInteger,   ///< int64
  kSeed,      ///< uint64
  kSwitch,    ///< bool
  kChoice,    ///< string: one of OptionInfo::words
  kNumbers,   ///< vector of OptionInfo::count doubles
  kDocument,  ///< string: the text of a file; empty = none
};

/// As the options struct keeps it: SI units, or the unit in the member's name.
using OptionValue =
    std::variant<bool, std::int64_t, std::uint64_t, double, std::string, std::vector<double>>;

/// What every surface needs to know of an option: the command line, records, and the panels.
struct OptionInfo {
  std::string key = "";    ///< in JSON and records: the member, "flying.threshold_m"
  std::string flag = "";   ///< on the command line: "--flying-threshold-mm"; empty = not there
  std::string group = "";  ///< heading on panels
  std::string title = "";  ///< on panels
  std::string help = "";   ///< one sentence or less, for command line and panels
  OptionType type = OptionType::kNumber;
  std::string unit = "";      ///< that people type: "mm", "deg", "px"; empty = none
  double units_per_si = 1.0;  ///< what people type, for one of the value
  double low = std::numeric_limits<double>::lowest();  ///< in the unit that people type
  double high = std::numeric_limits<double>::max();
  std::string automatic = "";           ///< what the value 0 means, where it stands for a rule
  std::vector<std::string> words = {};  ///< of a choice
  int count = 1;                        ///< of numbers
};

/// An option of a struct `T`.
template <class T>
struct Option {
  OptionInfo info;
  std::function<OptionValue(const T&)> get;
  /// Takes a value that CheckOption passed; fails with kInvalidOptions or kBadData where a document
  /// is not what it should be.
  std::function<Status(T&, const OptionValue&)> set;
  /// Whether the option does anything beside the others; empty = always.
  std::function<bool(const T&)> applies = {};

  bool AppliesTo(const T& options) const { return !applies || applies(options); }
};

template <class T>
using OptionTable = std::span<const Option<T>>;

/// The option of a table with this key; nullptr = there is none.
template <class T>
const Option<T>* FindOption(OptionTable<T> table, std::string_view key) {
  for (const Option<T>& option : table)
    if (option.info.key == key) return &option;
  return nullptr;
}

/// Type, range and word of a value. Fails with kInvalidOptions, naming the option and the value.
Status CheckOption(const OptionInfo& info, const OptionValue& value);

/// CheckOption, then the option's own `set`.
template <class T>
Status SetOption(const Option<T>& option, T& options, const OptionValue& value) {
  FORESIGHT_CHECK(CheckOption(option.info, value));
  return option.set(options, value);
}

/// Builders: `at` gives the member of an options struct by reference, const or not.
template <class T, class At>
Option<T> NumberOption(OptionInfo info, At at) {
  info.type = OptionType::kNumber;
  return {std::move(info), [at](const T& options) -> OptionValue { return double(at(options)); },
          [at](T& options, const OptionValue& value) -> Status {
            at(options) = std::get<double>(value);
            return {};
          }};
}

template <class T, class At>
Option<T> IntegerOption(OptionInfo info, At at) {
  info.type = OptionType::kInteger;
  return {std::move(info),
          [at](const T& options) -> OptionValue { return std::int64_t{at(options)}; },
          [at](T& options, const OptionValue& value) -> Status {
            at(options) = static_cast<int>(std::get<std::int64_t>(value));
            return {};
          }};
}

template <class T, class At>
Option<T> SeedOption(At at) {
  OptionInfo info{.key = "seed",
                  .flag = "--seed",
                  .group = "Search",
                  .title = "Seed",
                  .help = "Seed of the random search",
                  .type = OptionType::kSeed};
  return {std::move(info),
          [at](const T& options) -> OptionValue { return std::uint64_t{at(options)}; },
          [at](T& options, const OptionValue& value) -> Status {
            at(options) = std::get<std::uint64_t>(value);
            return {};
          }};
}

template <class T, class At>
Option<T> SwitchOption(OptionInfo info, At at) {
  info.type = OptionType::kSwitch;
  return {std::move(info), [at](const T& options) -> OptionValue { return bool{at(options)}; },
          [at](T& options, const OptionValue& value) -> Status {
            at(options) = std::get<bool>(value);
            return {};
          }};
}

template <class T, class E, class At>
Option<T> ChoiceOption(OptionInfo info, std::vector<std::pair<std::string, E>> words, At at) {
  info.type = OptionType::kChoice;
  for (const auto& [word, meaning] : words) info.words.push_back(word);
  return {std::move(info),
          [at, words](const T& options) -> OptionValue {
            for (const auto& [word, meaning] : words)
              if (meaning == at(options)) return word;
            return std::string();
          },
          [at, words](T& options, const OptionValue& value) -> Status {
            for (const auto& [word, meaning] : words)
              if (word == std::get<std::string>(value)) at(options) = meaning;
            return {};
          }};
}

}  // namespace foresight
