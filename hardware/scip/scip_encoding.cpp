#include "hardware/scip/scip_encoding.h"

namespace foresight {
namespace {

constexpr unsigned char kZero = 0x30;
constexpr unsigned char kLast = 0x6F;

}  // namespace

std::string EncodeScipValue(std::uint32_t value, int characters) {
  std::string text(static_cast<std::size_t>(characters), '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 6)
    *digit = static_cast<char>((value & 0x3F) + kZero);
  return text;
}

std::optional<std::uint32_t> DecodeScipValue(std::string_view text) {
  std::uint32_t value = 0;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < kZero || byte > kLast) return std::nullopt;
    value = value << 6 | static_cast<std::uint32_t>(byte - kZero);
  }
  return value;
}

char ScipSum(std::string_view text) {
  unsigned sum = 0;
  for (const char character : text) sum += static_cast<unsigned char>(character);
  return static_cast<char>((sum & 0x3F) + kZero);
}

std::string WithScipSum(std::string_view text) {
  return std::string(text) + ScipSum(text);
}

bool ScipSumMatches(std::string_view line) {
  return !line.empty() && line.back() == ScipSum(line.substr(0, line.size() - 1));
}

}  // namespace foresight
