#pragma once

#include <span>
#include <string>
#include <string_view>

namespace foresight {

/// The word that `typed` was most likely meant to be: the one with the fewest letters to insert,
/// remove, replace or swap; empty where more than a third of the letters would have to change.
std::string NearestWord(std::string_view typed, std::span<const std::string> words);

}  // namespace foresight
