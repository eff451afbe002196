#include "core/base/printable.h"

#include <fmt/format.h>

namespace foresight {
namespace {

/// Bytes of the UTF-8 character that `text` begins with; 0 where it begins with none. Overlong
/// forms, surrogates and numbers beyond Unicode are none.
std::size_t CharacterBytes(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t count = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < count) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool overlong = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
  const bool surrogate = first == 0xed && byte(1) > 0x9f;
  const bool beyond = first == 0xf4 && byte(1) > 0x8f;
  return overlong || surrogate || beyond ? 0 : count;
}

/// C0 and C1 of Unicode, and DEL: what moves a terminal's cursor or worse.
bool IsControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

void AppendEscaped(std::string_view bytes, std::string& printable) {
  for (const char c : bytes) {
    if (c == '\n')
      printable += "\\n";
    else if (c == '\r')
      printable += "\\r";
    else if (c == '\t')
      printable += "\\t";
    else
      printable += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
}

std::string Escaped(std::string_view text, bool keep_line_feeds) {
  std::string printable;
  printable.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = CharacterBytes(text);
    const std::string_view character = text.substr(0, bytes == 0 ? 1 : bytes);
    const bool kept = bytes != 0 && (!IsControl(character) || (keep_line_feeds && text[0] == '\n'));
    if (kept)
      printable += character;
    else
      AppendEscaped(character, printable);
    text.remove_prefix(character.size());
  }
  return printable;
}

}  // namespace

std::string Printable(std::string_view text) {
  return Escaped(text, false);
}

std::string PrintableLines(std::string_view text) {
  return Escaped(text, true);
}

std::size_t FirstInvalidUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = CharacterBytes(text.substr(at, 4));
    if (bytes == 0) return at;
    at += bytes;
  }
  return std::string_view::npos;
}

}  // namespace foresight
