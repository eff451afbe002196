#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace foresight {

/// Results go to standard output, all of it in one piece.
void PrintJson(const nlohmann::ordered_json& json);
void PrintLine(const std::string& line);

}  // namespace foresight
