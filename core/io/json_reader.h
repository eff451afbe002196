#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace foresight {

/// Members of a JSON object, checked: whoever reads a file must not believe it. Readers throw
/// std::invalid_argument, or what nlohmann throws, with the member's name and its value; a reader
/// of a whole file turns that into an error.

/// A number in [low, high].
double NumberIn(const nlohmann::json& object, const char* key, double low, double high);
/// A whole number in [low, high]; 3.0 is none, and neither is what no int holds.
int IntegerIn(const nlohmann::json& object, const char* key, int low, int high);
/// The elements of a list, at most `most` of them.
const nlohmann::json& ListIn(const nlohmann::json& object, const char* key, std::size_t most);

/// JSON text with no more than kMostJsonLevels lists and objects inside each other. Throws
/// nlohmann::json::parse_error, with the byte, and std::invalid_argument.
nlohmann::json ParseJson(std::string_view text);
inline constexpr int kMostJsonLevels = 64;

}  // namespace foresight
