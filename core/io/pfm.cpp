#include "core/io/pfm.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/base/atomic_file.h"
#include "core/io/image_limits.h"

namespace foresight {
namespace {

bool IsPfmSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Takes the next word of the header; a word ends at exactly one white space.
std::string_view TakeWord(std::string_view& rest) {
  while (!rest.empty() && IsPfmSpace(rest.front())) rest.remove_prefix(1);
  std::size_t length = 0;
  while (length < rest.size() && length < 64 && !IsPfmSpace(rest[length])) ++length;
  const std::string_view word = rest.substr(0, length);
  rest.remove_prefix(std::min(length + 1, rest.size()));
  return word;
}

template <class Number>
bool Parse(std::string_view word, Number& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

std::uint32_t ByteSwapped(std::uint32_t v) {
  return v >> 24 | (v >> 8 & 0xff00U) | (v << 8 & 0xff0000U) | v << 24;
}

void CopyRow(const char* source, bool little_endian, int width, float* target) {
  std::memcpy(target, source, sizeof(float) * static_cast<std::size_t>(width));
  if (little_endian == (std::endian::native == std::endian::little)) return;
  for (int x = 0; x < width; ++x)
    target[x] = std::bit_cast<float>(ByteSwapped(std::bit_cast<std::uint32_t>(target[x])));
}

}  // namespace

Result<FloatImage> ReadPfm(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  std::string_view rest = bytes;
  const std::string_view magic = TakeWord(rest);
  if (magic == "PF")
    return Fail(ErrorCode::kBadData, "{}: is a colour float map ('PF'); one channel ('Pf') is read",
                path.string());
  if (magic != "Pf")
    return Fail(ErrorCode::kBadData, "{}: is not a portable float map: it does not start with 'Pf'",
                path.string());
  int width = 0, height = 0;
  double scale = 0.0;
  const std::string_view width_word = TakeWord(rest);
  const std::string_view height_word = TakeWord(rest);
  if (!Parse(width_word, width) || !Parse(height_word, height) || width < 1 || height < 1 ||
      width > kMaxImageSide || height > kMaxImageSide)
    return Fail(ErrorCode::kBadData, "{}: size '{}' x '{}' is not between 1 and {}", path.string(),
                width_word, height_word, kMaxImageSide);
  const std::string_view scale_word = TakeWord(rest);
  if (!Parse(scale_word, scale) || !std::isfinite(scale) || scale == 0.0)
    return Fail(ErrorCode::kBadData, "{}: scale '{}' is not a number other than 0", path.string(),
                scale_word);

  const std::size_t row_bytes = sizeof(float) * static_cast<std::size_t>(width);
  const std::size_t needed = row_bytes * static_cast<std::size_t>(height);
  if (rest.size() < needed)
    return Fail(ErrorCode::kBadData, "{}: {} x {} pixels need {} bytes, the file has {}",
                path.string(), width, height, needed, rest.size());
  FloatImage image(width, height);
  for (int y = 0; y < height; ++y)
    CopyRow(rest.data() + row_bytes * static_cast<std::size_t>(height - 1 - y), scale < 0.0, width,
            image.row(y));
  return image;
}

Status WritePfm(const std::filesystem::path& path, const FloatImage& image) {
  static_assert(std::endian::native == std::endian::little, "rows are written as they lie");
  if (image.empty() || image.width() > kMaxImageSide || image.height() > kMaxImageSide)
    return Fail(ErrorCode::kInvalidInput, "{}: an image of {} x {} cannot become a float map",
                path.string(), image.width(), image.height());
  std::string bytes = fmt::format("Pf\n{} {}\n-1.0\n", image.width(), image.height());
  const std::size_t row_bytes = sizeof(float) * static_cast<std::size_t>(image.width());
  bytes.reserve(bytes.size() + row_bytes * static_cast<std::size_t>(image.height()));
  for (int y = image.height() - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(image.row(y)), row_bytes);
  return WriteFileAtomically(path, bytes);
}

}  // namespace foresight
