#include "core/io/image_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>

#include "core/base/atomic_file.h"
#include "core/io/image_limits.h"
#include "core/io/png.h"

namespace foresight {
namespace {

bool IsSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/// The next number of a PGM's header, after spaces and comments.
std::optional<int> NextNumber(std::string_view& text) {
  for (;;) {
    while (!text.empty() && IsSpace(text.front())) text.remove_prefix(1);
    if (text.empty() || text.front() != '#') break;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
  int number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

Result<GrayImage> DecodePgm(std::string_view bytes, const std::string& source) {
  std::string_view rest = bytes.substr(2);
  const auto width = NextNumber(rest), height = NextNumber(rest), largest = NextNumber(rest);
  if (!width || !height || !largest || *width < 1 || *height < 1 || *width > kMaxImageSide ||
      *height > kMaxImageSide || rest.empty())
    return Fail(ErrorCode::kBadData, "{}: damaged PGM: its header has no size of an image", source);
  if (*largest != 255)
    return Fail(ErrorCode::kBadData, "{}: PGM with values up to {}; expected 255", source,
                *largest);
  rest.remove_prefix(1);
  const std::size_t pixels = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
  if (rest.size() < pixels)
    return Fail(ErrorCode::kBadData, "{}: damaged PGM: {} bytes for {} x {} pixels", source,
                rest.size(), *width, *height);
  GrayImage image(*width, *height);
  std::memcpy(image.data(), rest.data(), pixels);
  return image;
}

}  // namespace

Result<GrayImage> DecodeImageGray(std::string_view bytes, const std::string& source) {
  if (bytes.starts_with("\x89PNG")) return DecodePngGray(bytes, source);
  if (bytes.starts_with("\xff\xd8")) return DecodeJpegGray(bytes, source);
  if (bytes.starts_with("P5")) return DecodePgm(bytes, source);
  return Fail(ErrorCode::kBadData, "{}: is no PNG, JPEG or binary PGM file", source);
}

Result<GrayImage> ReadImageGray(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  return DecodeImageGray(bytes, path.string());
}

bool HasImageExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".pgm";
}

}  // namespace foresight
