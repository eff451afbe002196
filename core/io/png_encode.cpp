#include <png.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/io/image_limits.h"
#include "core/io/png.h"

namespace foresight {
namespace {

// A 1288 x 964 image takes a third of the time of zlib's default level for a few per cent more
// bytes, and the recorder must keep up with the camera.
constexpr int kCompressionLevel = 3;

/// See Decoder in png_decode.cpp: libpng leaves by longjmp.
struct Encoder {
  ~Encoder() { png_destroy_write_struct(&png, &info); }

  std::string bytes;
  std::array<char, 160> message{};
  png_structp png = nullptr;
  png_infop info = nullptr;
};

[[noreturn]] void OnEncodeError(png_structp png, png_const_charp message) {
  auto* encoder = static_cast<Encoder*>(png_get_error_ptr(png));
  std::strncpy(encoder->message.data(), message, encoder->message.size() - 1);
  png_longjmp(png, 1);
}

void OnEncodeWarning(png_structp, png_const_charp) {}

void OnWrite(png_structp png, png_bytep data, std::size_t count) {
  bool written = true;
  try {
    static_cast<Encoder*>(png_get_io_ptr(png))
        ->bytes.append(reinterpret_cast<const char*>(data), count);
  } catch (const std::bad_alloc&) {
    written = false;
  }
  if (!written) png_error(png, "out of memory");
}

void OnFlush(png_structp) {}

struct EncodedLayout {
  int color_type;
  int bit_depth;
  PngContent content = PngContent::kDrawing;
};

/// What is written does not repeat in a capture: only how often a difference occurs helps, and its
/// means of two neighbours have less noise than one. An image of 1288 x 964 is an eighth smaller
/// and takes 36 ms instead of 93 (chunks_benchmark).
void ChooseCompression(png_structp png, PngContent content) {
  png_set_compression_level(png, kCompressionLevel);
  if (content == PngContent::kDrawing) {
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
    return;
  }
  png_set_compression_strategy(png, Z_RLE);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG);
}

bool WriteRows(Encoder& encoder, int width, int height, EncodedLayout layout, png_bytepp rows) {
  encoder.png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, OnEncodeError, OnEncodeWarning);
  if (encoder.png == nullptr) return false;
  if (setjmp(png_jmpbuf(encoder.png)) != 0) return false;
  encoder.info = png_create_info_struct(encoder.png);
  if (encoder.info == nullptr) return false;
  png_set_write_fn(encoder.png, &encoder, OnWrite, OnFlush);
  ChooseCompression(encoder.png, layout.content);
  png_set_IHDR(encoder.png, encoder.info, static_cast<png_uint_32>(width),
               static_cast<png_uint_32>(height), layout.bit_depth, layout.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(encoder.png, encoder.info);
  if (layout.bit_depth == 16 && std::endian::native == std::endian::little)
    png_set_swap(encoder.png);
  png_write_image(encoder.png, rows);
  png_write_end(encoder.png, nullptr);
  return true;
}

template <class Pixel>
Result<std::string> Encode(const Image<Pixel>& image, EncodedLayout layout) {
  if (image.empty() || image.width() > kMaxImageSide || image.height() > kMaxImageSide)
    return Fail(ErrorCode::kInvalidInput, "an image of {} x {} cannot become a PNG file",
                image.width(), image.height());
  Encoder encoder;
  std::vector<png_bytep> rows;
  // libpng's write interface is not const correct; it does not change the rows.
  for (int y = 0; y < image.height(); ++y)
    rows.push_back(reinterpret_cast<png_bytep>(const_cast<Pixel*>(image.row(y))));
  if (!WriteRows(encoder, image.width(), image.height(), layout, rows.data()))
    return Fail(ErrorCode::kIo, "PNG encoder: {}",
                encoder.message[0] != '\0' ? encoder.message.data() : "out of memory");
  return std::move(encoder.bytes);
}

}  // namespace

Result<std::string> EncodePng(const ColorImage& image, PngContent content) {
  return Encode(image, {PNG_COLOR_TYPE_RGB, 8, content});
}

Result<std::string> EncodePng(const GrayImage& image) {
  return Encode(image, {PNG_COLOR_TYPE_GRAY, 8});
}

Result<std::string> EncodePng16(const Image<std::uint16_t>& image) {
  return Encode(image, {PNG_COLOR_TYPE_GRAY, 16});
}

Status WritePng(const std::filesystem::path& path, const ColorImage& image, PngContent content) {
  FORESIGHT_TRY(const std::string bytes, EncodePng(image, content));
  return WriteFileAtomically(path, bytes);
}

Status WritePng(const std::filesystem::path& path, const GrayImage& image) {
  FORESIGHT_TRY(const std::string bytes, EncodePng(image));
  return WriteFileAtomically(path, bytes);
}

Status WritePng16(const std::filesystem::path& path, const Image<std::uint16_t>& image) {
  FORESIGHT_TRY(const std::string bytes, EncodePng16(image));
  return WriteFileAtomically(path, bytes);
}

}  // namespace foresight
