#include "tests/nasty/mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <vector>

namespace foresight::nasty {
namespace {

std::size_t Place(const std::string& bytes, Random& random) {
  return bytes.empty()
             ? 0
             : static_cast<std::size_t>(random.Uniform() * static_cast<double>(bytes.size()));
}

template <std::size_t N>
const char* OneOf(const std::array<const char*, N>& words, Random& random) {
  return words[static_cast<std::size_t>(random.Index(static_cast<int>(N)))];
}

void Cut(std::string& bytes, Random& random) {
  bytes.resize(Place(bytes, random));
}

void FlipBit(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  char& byte = bytes[Place(bytes, random)];
  byte = static_cast<char>(byte ^ (1 << random.Index(8)));
}

/// Sizes and counts in binary headers.
void OverwriteNumber(std::string& bytes, Random& random) {
  constexpr std::array<std::uint32_t, 6> kNumbers = {0,          1,          0x7fffffff,
                                                     0x80000000, 0xffffffff, 0x7fc00000};
  if (bytes.size() < 4) return;
  const std::size_t at = std::min(Place(bytes, random), bytes.size() - 4);
  std::memcpy(bytes.data() + at, &kNumbers[static_cast<std::size_t>(random.Index(6))], 4);
}

void EraseOrRepeat(std::string& bytes, Random& random) {
  const std::size_t at = Place(bytes, random);
  const std::size_t count = std::min<std::size_t>(bytes.size() - at, 1 + random.Index(64));
  if (random.Index(2) == 0)
    bytes.erase(at, count);
  else
    bytes.insert(at, bytes.substr(at, count));
}

void InsertBytes(std::string& bytes, Random& random) {
  std::string fresh;
  for (int i = 1 + random.Index(16); i > 0; --i) fresh += static_cast<char>(random.Index(256));
  bytes.insert(Place(bytes, random), fresh);
}

bool InWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+' ||
         c == '_';
}

/// A word of the text at random; [begin, end).
std::pair<std::size_t, std::size_t> Word(const std::string& text, bool number, Random& random) {
  std::vector<std::pair<std::size_t, std::size_t>> words;
  for (std::size_t begin = 0; begin < text.size();) {
    if (!InWord(text[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < text.size() && InWord(text[end])) ++end;
    const bool digits = std::isdigit(static_cast<unsigned char>(text[end - 1])) != 0;
    if (digits == number) words.emplace_back(begin, end);
    begin = end;
  }
  if (words.empty()) return {0, 0};
  return words[static_cast<std::size_t>(random.Index(static_cast<int>(words.size())))];
}

void ReplaceNumber(std::string& text, Random& random) {
  constexpr std::array<const char*, 20> kNumbers = {
      "nan",   ".nan",       "inf",        "-.inf",
      "1e308", "-1e308",     "1.0e308",    "1e-308",
      "0",     "-1",         "1e9",        "1000000000",
      "1e999", "4294967296", "2147483648", "999999999999999999999999999",
      "",      "null",       "0.5",        "1e4"};
  const auto [begin, end] = Word(text, true, random);
  text.replace(begin, end - begin, OneOf(kNumbers, random));
}

void ReplaceWord(std::string& text, Random& random) {
  constexpr std::array<const char*, 12> kWords = {
      "true", "[]", "{}", "\"\"", "~", "&a", "*a", "!!binary x", "\xff\xfe", "\x1b[2J", "|", "5"};
  const auto [begin, end] = Word(text, false, random);
  text.replace(begin, end - begin, OneOf(kWords, random));
}

void EraseOrRepeatLine(std::string& text, Random& random) {
  const std::size_t at = Place(text, random);
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(text.find('\n', at), text.size());
  const std::string line = text.substr(begin, end - begin) + "\n";
  if (random.Index(2) == 0)
    text.erase(begin, end - begin);
  else
    text.insert(begin, line);
}

void InsertNesting(std::string& text, Random& random) {
  constexpr std::array<const char*, 3> kOpening = {"[", "{\"a\":", "- "};
  const char* opening = OneOf(kOpening, random);
  std::string nest;
  for (int i = 0; i < 5000; ++i) nest += opening;
  text.insert(Place(text, random), nest);
}

}  // namespace

std::string MutatedBytes(const std::string& bytes, Random& random) {
  using Fault = void (*)(std::string&, Random&);
  constexpr std::array<Fault, 5> kFaults = {Cut, FlipBit, OverwriteNumber, EraseOrRepeat,
                                            InsertBytes};
  std::string mutated = bytes;
  for (int i = 1 + random.Index(4); i > 0; --i)
    kFaults[static_cast<std::size_t>(random.Index(5))](mutated, random);
  return mutated;
}

std::string MutatedText(const std::string& text, Random& random) {
  using Fault = void (*)(std::string&, Random&);
  // Numbers first and most: they are what readers believe.
  constexpr std::array<Fault, 10> kFaults = {
      ReplaceNumber, ReplaceNumber,     ReplaceNumber, ReplaceNumber, ReplaceWord,
      ReplaceWord,   EraseOrRepeatLine, Cut,           InsertBytes,   InsertNesting};
  std::string mutated = text;
  for (int i = 1 + random.Index(2); i > 0; --i)
    kFaults[static_cast<std::size_t>(random.Index(10))](mutated, random);
  return mutated;
}

}  // namespace foresight::nasty
