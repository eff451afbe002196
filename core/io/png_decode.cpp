#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/io/image_limits.h"
#include "core/io/png.h"

namespace foresight {
namespace {

// No camera of ours, and 600 MB as colours: a small file can hold that many equal pixels.
constexpr std::uint64_t kMostPixels = 200'000'000;
// deflate cannot expand more than 1032 times: a small file that claims a huge image is damaged,
// and it is refused before the memory for it is asked for.
constexpr std::size_t kMaxExpansion = 1040;

/// What libpng works on. libpng leaves its calls by longjmp, so the functions that set a jump point
/// own nothing that needs a destructor; everything lives here.
struct Decoder {
  explicit Decoder(std::string_view input) : bytes(input) {}
  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  std::string_view bytes;
  std::size_t offset = 0;
  std::array<char, 160> message{};
  png_structp png = nullptr;
  png_infop info = nullptr;
};

[[noreturn]] void OnError(png_structp png, png_const_charp message) {
  auto* decoder = static_cast<Decoder*>(png_get_error_ptr(png));
  std::strncpy(decoder->message.data(), message, decoder->message.size() - 1);
  png_longjmp(png, 1);
}

void OnWarning(png_structp, png_const_charp) {}

void OnRead(png_structp png, png_bytep target, std::size_t count) {
  auto* decoder = static_cast<Decoder*>(png_get_io_ptr(png));
  if (count > decoder->bytes.size() - decoder->offset)
    png_error(png, "the file ends within the image");
  std::memcpy(target, decoder->bytes.data() + decoder->offset, count);
  decoder->offset += count;
}

enum class Layout { kColor, kGray, kGray16 };

/// Reads the header and asks libpng for rows in `layout`. False leaves the reason in message.
bool Start(Decoder& decoder, Layout layout) {
  decoder.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoder, OnError, OnWarning);
  if (decoder.png == nullptr) return false;
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  decoder.info = png_create_info_struct(decoder.png);
  if (decoder.info == nullptr) return false;
  png_set_read_fn(decoder.png, &decoder, OnRead);
  png_set_user_limits(decoder.png, kMaxImageSide, kMaxImageSide);
  png_read_info(decoder.png, decoder.info);

  if (layout == Layout::kGray16) {
    // Numbers, not an image: nothing is scaled or converted.
    if (png_get_color_type(decoder.png, decoder.info) != PNG_COLOR_TYPE_GRAY ||
        png_get_bit_depth(decoder.png, decoder.info) != 16)
      png_error(decoder.png, "not one channel of 16 bits");
    static_assert(std::endian::native == std::endian::little);
    png_set_swap(decoder.png);
    png_set_interlace_handling(decoder.png);
    png_read_update_info(decoder.png, decoder.info);
    return true;
  }
  const bool has_color =
      (png_get_color_type(decoder.png, decoder.info) & PNG_COLOR_MASK_COLOR) != 0;
  png_set_expand(decoder.png);
  png_set_scale_16(decoder.png);
  png_set_strip_alpha(decoder.png);
  if (layout == Layout::kColor && !has_color) png_set_gray_to_rgb(decoder.png);
  if (layout == Layout::kGray && has_color)
    png_set_rgb_to_gray_fixed(decoder.png, PNG_ERROR_ACTION_NONE, -1, -1);
  png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  return true;
}

bool ReadRows(Decoder& decoder, png_bytepp rows) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_image(decoder.png, rows);
  png_read_end(decoder.png, nullptr);
  return true;
}

template <class Pixel>
Result<Image<Pixel>> Decode(std::string_view bytes, const std::string& source, Layout layout) {
  if (bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) != 0)
    return Fail(ErrorCode::kBadData, "{}: is not a PNG file", source);
  Decoder decoder(bytes);
  const auto fail = [&] {
    const char* reason = decoder.message[0] != '\0' ? decoder.message.data() : "out of memory";
    return Fail(ErrorCode::kBadData, "{}: damaged PNG: {}", source, reason);
  };
  if (!Start(decoder, layout)) return fail();

  const png_uint_32 width = png_get_image_width(decoder.png, decoder.info);
  const png_uint_32 height = png_get_image_height(decoder.png, decoder.info);
  const std::size_t row_bytes = png_get_rowbytes(decoder.png, decoder.info);
  if (row_bytes != width * sizeof(Pixel))
    return Fail(ErrorCode::kBadData, "{}: PNG rows of {} bytes for {} pixels", source, row_bytes,
                width);
  // One bit a pixel is the densest that a file can hold.
  if (std::size_t{width} * height / 8 > bytes.size() * kMaxExpansion)
    return Fail(ErrorCode::kBadData, "{}: {} bytes cannot hold an image of {} x {}", source,
                bytes.size(), width, height);
  if (std::uint64_t{width} * height > kMostPixels)
    return Fail(ErrorCode::kBadData, "{}: {} x {} pixels are more than {} million", source, width,
                height, kMostPixels / 1'000'000);
  try {
    Image<Pixel> image(static_cast<int>(width), static_cast<int>(height));
    std::vector<png_bytep> rows(height);
    for (png_uint_32 y = 0; y < height; ++y)
      rows[y] = reinterpret_cast<png_bytep>(image.row(static_cast<int>(y)));
    if (!ReadRows(decoder, rows.data())) return fail();
    return image;
  } catch (const std::bad_alloc&) {
    return Fail(ErrorCode::kIo, "{}: its {} x {} pixels do not fit into memory", source, width,
                height);
  }
}

}  // namespace

static_assert(sizeof(Rgb8) == 3, "rows are handed to libpng as they lie in memory");

Result<ColorImage> DecodePng(std::string_view bytes, const std::string& source) {
  return Decode<Rgb8>(bytes, source, Layout::kColor);
}

Result<GrayImage> DecodePngGray(std::string_view bytes, const std::string& source) {
  return Decode<std::uint8_t>(bytes, source, Layout::kGray);
}

Result<Image<std::uint16_t>> DecodePng16(std::string_view bytes, const std::string& source) {
  return Decode<std::uint16_t>(bytes, source, Layout::kGray16);
}

Result<ColorImage> ReadPng(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  return DecodePng(bytes, path.string());
}

Result<GrayImage> ReadPngGray(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  return DecodePngGray(bytes, path.string());
}

Result<Image<std::uint16_t>> ReadPng16(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  return DecodePng16(bytes, path.string());
}

}  // namespace foresight
