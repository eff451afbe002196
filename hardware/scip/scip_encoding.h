#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace foresight {

/// SCIP writes a number as 6-bit digits, each + 0x30, the highest first: 1234 is "0CB". Two
/// characters reach 4095, three 262143, four 16777215.
std::string EncodeScipValue(std::uint32_t value, int characters);
/// nullopt when a character is none of 0x30 to 0x6F.
std::optional<std::uint32_t> DecodeScipValue(std::string_view text);

/// The character that guards `text`: its bytes' sum, the low 6 bits, + 0x30.
char ScipSum(std::string_view text);
/// `text` and its sum.
std::string WithScipSum(std::string_view text);
/// Whether the last character of `line` is the sum of the others.
bool ScipSumMatches(std::string_view line);

}  // namespace foresight
