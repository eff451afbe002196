#include "core/mission/json_differences.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace foresight {
namespace {

using Json = nlohmann::json;

/// Never throws on what stands in a file.
std::string Text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> Compare(const Json& was, const Json& is) {
  std::vector<std::string> differences;
  if (was == is) return differences;
  if (!was.is_structured() || was.type() != is.type()) {
    differences.push_back(fmt::format("was {}, is {}", Text(was), Text(is)));
    return differences;
  }
  const Json old_leaves = was.flatten(), new_leaves = is.flatten();
  for (const auto& [at, value] : old_leaves.items()) {
    if (!new_leaves.contains(at))
      differences.push_back(fmt::format("{}: was {}, is gone", at, Text(value)));
    else if (new_leaves.at(at) != value)
      differences.push_back(
          fmt::format("{}: was {}, is {}", at, Text(value), Text(new_leaves.at(at))));
  }
  for (const auto& [at, value] : new_leaves.items())
    if (!old_leaves.contains(at))
      differences.push_back(fmt::format("{}: is new, {}", at, Text(value)));
  return differences;
}

}  // namespace

std::vector<std::string> JsonDifferences(std::string_view was, std::string_view is,
                                         const std::vector<std::string>& except) {
  if (was == is) return {};
  Json old_json = Json::parse(was, nullptr, false);
  Json new_json = Json::parse(is, nullptr, false);
  if (old_json.is_discarded() || new_json.is_discarded())
    return {fmt::format("was '{}', is '{}'", was, is)};
  for (Json* json : {&old_json, &new_json})
    for (const std::string& member : except)
      if (json->is_object()) json->erase(member);
  return Compare(old_json, new_json);
}

}  // namespace foresight
