#include "core/options/option_json.h"

#include <nlohmann/json.hpp>

#include "core/io/json_reader.h"

namespace foresight {
namespace {

using Json = nlohmann::json;

OptionValue ValueFrom(const OptionInfo& info, const Json& value) {
  switch (info.type) {
    case OptionType::kNumber:
      return value.get<double>();
    case OptionType::kInteger:
      if (!value.is_number_integer()) throw std::invalid_argument("no whole number");
      return value.get<std::int64_t>();
    case OptionType::kSeed:
      if (!value.is_number_unsigned()) throw std::invalid_argument("no seed");
      return value.get<std::uint64_t>();
    case OptionType::kSwitch:
      return value.get<bool>();
    case OptionType::kNumbers:
      return value.get<std::vector<double>>();
    case OptionType::kChoice:
    case OptionType::kDocument:
      break;
  }
  return value.get<std::string>();
}

}  // namespace

std::string ToJson(const std::vector<KeyedValue>& values) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [key, value] : values)
    std::visit([&, key = &key](const auto& held) { object[*key] = held; }, value);
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<std::vector<KeyedValue>> KeyedValuesFromJson(
    const std::string& json, const std::function<const OptionInfo*(const std::string&)>& find) {
  std::string at = "options";
  try {
    const Json object = ParseJson(json);
    if (!object.is_object()) return Fail(ErrorCode::kBadData, "options: no JSON object");
    std::vector<KeyedValue> values;
    for (const auto& [key, value] : object.items()) {
      at = "option " + key;
      const OptionInfo* info = find(key);
      if (info == nullptr)
        return Fail(ErrorCode::kBadData, "option {} is not known to this program", key);
      values.emplace_back(key, ValueFrom(*info, value));
      const Status sound = CheckOption(*info, values.back().second);
      if (!sound) return Fail(ErrorCode::kBadData, "{}", sound.error().message);
    }
    return values;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "{}: {}", at, failure.what());
  }
}

}  // namespace foresight
