#include "core/io/json_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace foresight {
namespace {

/// As it stands in the file, cut where it is long.
std::string Excerpt(const nlohmann::json& value) {
  constexpr std::size_t kLongest = 40;
  if (value.is_structured()) return value.is_array() ? "a list" : "an object";
  std::string text = value.dump();
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

[[noreturn]] void Refuse(const char* key, const nlohmann::json& value, const std::string& wanted) {
  throw std::invalid_argument(fmt::format("'{}' is {}, not {}", key, Excerpt(value), wanted));
}

}  // namespace

double NumberIn(const nlohmann::json& object, const char* key, double low, double high) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_number()) Refuse(key, value, "a number");
  const double number = value.get<double>();
  if (!(number >= low && number <= high)) Refuse(key, value, fmt::format("{} to {}", low, high));
  return number;
}

int IntegerIn(const nlohmann::json& object, const char* key, int low, int high) {
  const nlohmann::json& value = object.at(key);
  const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
  if (!value.is_number_integer()) Refuse(key, value, wanted);
  const bool fits = value.is_number_unsigned()
                        ? high >= 0 && value.get<std::uint64_t>() <= static_cast<unsigned>(high)
                        : value.get<std::int64_t>() <= high;
  if (!fits || value.get<std::int64_t>() < low) Refuse(key, value, wanted);
  return value.get<int>();
}

const nlohmann::json& ListIn(const nlohmann::json& object, const char* key, std::size_t most) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_array()) Refuse(key, value, "a list");
  if (value.size() > most)
    throw std::invalid_argument(
        fmt::format("'{}' has {} entries, more than {}", key, value.size(), most));
  return value;
}

nlohmann::json ParseJson(std::string_view text) {
  const auto not_too_deep = [](int depth, nlohmann::json::parse_event_t event, nlohmann::json&) {
    using Event = nlohmann::json::parse_event_t;
    if ((event == Event::object_start || event == Event::array_start) && depth >= kMostJsonLevels)
      throw std::invalid_argument(
          fmt::format("more than {} lists and objects inside each other", kMostJsonLevels));
    return true;
  };
  return nlohmann::json::parse(text, not_too_deep);
}

}  // namespace foresight
