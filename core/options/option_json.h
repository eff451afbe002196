#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/options/option.h"

namespace foresight {

/// An option and its value, by the option's key.
using KeyedValue = std::pair<std::string, OptionValue>;

/// A JSON object as text, one line.
std::string ToJson(const std::vector<KeyedValue>& values);

/// The values of a JSON object for options that `find` knows by their keys. Fails with kBadData: no
/// object, an unknown key, a value that the option does not take.
Result<std::vector<KeyedValue>> KeyedValuesFromJson(
    const std::string& json, const std::function<const OptionInfo*(const std::string&)>& find);

/// Every option of the table that does anything beside the others, as one line of JSON.
template <class T>
std::string OptionsToJson(OptionTable<T> table, const T& options) {
  std::vector<KeyedValue> values;
  for (const Option<T>& option : table)
    if (option.AppliesTo(options)) values.emplace_back(option.info.key, option.get(options));
  return ToJson(values);
}

/// Sets the options that the JSON object names, in the table's order; the others stay. Fails as
/// KeyedValuesFromJson does.
template <class T>
Status OptionsFromJson(OptionTable<T> table, const std::string& json, T& options) {
  FORESIGHT_TRY(const std::vector<KeyedValue> values,
                KeyedValuesFromJson(json, [&](const std::string& key) -> const OptionInfo* {
                  const Option<T>* option = FindOption(table, key);
                  return option == nullptr ? nullptr : &option->info;
                }));
  for (const Option<T>& option : table)
    for (const auto& [key, value] : values)
      if (key == option.info.key) FORESIGHT_CHECK(SetOption(option, options, value));
  return {};
}

}  // namespace foresight
