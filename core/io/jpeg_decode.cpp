#include <fmt/format.h>

#include <cstdio>
// libjpeg's header needs size_t and FILE, but includes neither.
#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <new>
#include <vector>

#include "core/io/image_file.h"
#include "core/io/image_limits.h"
#include "core/io/jpeg.h"

namespace foresight {
namespace {

constexpr std::uint64_t kJpegMostPixels = 200'000'000;
// A block of 8 x 8 pixels needs at least a few bits; progressive files may leave whole scans out,
// so the guard is generous. It keeps a small file from asking for a huge image.
constexpr std::uint64_t kMostPixelsPerByte = 4096;

/// What libjpeg works on. Errors leave its calls by longjmp, so the functions that set a jump point
/// own nothing that needs a destructor; everything lives here.
struct JpegDecoder {
  JpegDecoder() {
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = OnError;
    errors.emit_message = OnMessage;
    jpeg.client_data = this;
  }
  ~JpegDecoder() {
    if (created) jpeg_destroy_decompress(&jpeg);
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  [[noreturn]] static void OnError(j_common_ptr common) {
    auto* decoder = static_cast<JpegDecoder*>(common->client_data);
    common->err->format_message(common, decoder->message.data());
    std::longjmp(decoder->jump, 1);
  }
  /// Level -1 is a warning: the data are damaged and libjpeg would go on with grey.
  static void OnMessage(j_common_ptr common, int level) {
    if (level < 0) OnError(common);
  }

  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf jump{};
  bool created = false;
  std::array<char, JMSG_LENGTH_MAX> message{};
};

bool Start(JpegDecoder& decoder, std::string_view bytes, J_COLOR_SPACE color_space) {
  if (setjmp(decoder.jump) != 0) return false;
  jpeg_create_decompress(&decoder.jpeg);
  decoder.created = true;
  decoder.jpeg.client_data = &decoder;
  jpeg_mem_src(&decoder.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder.jpeg, TRUE);
  decoder.jpeg.out_color_space = color_space;
  jpeg_calc_output_dimensions(&decoder.jpeg);
  return true;
}

bool ReadRows(JpegDecoder& decoder, JSAMPROW* rows) {
  if (setjmp(decoder.jump) != 0) return false;
  jpeg_start_decompress(&decoder.jpeg);
  while (decoder.jpeg.output_scanline < decoder.jpeg.output_height)
    jpeg_read_scanlines(&decoder.jpeg, rows + decoder.jpeg.output_scanline,
                        decoder.jpeg.output_height - decoder.jpeg.output_scanline);
  jpeg_finish_decompress(&decoder.jpeg);
  return true;
}

template <class Pixel>
Result<Image<Pixel>> Decode(std::string_view bytes, const std::string& source,
                            J_COLOR_SPACE color_space, std::uint64_t most_pixels) {
  JpegDecoder decoder;
  const auto fail = [&] {
    return Fail(ErrorCode::kBadData, "{}: damaged JPEG: {}", source, decoder.message.data());
  };
  if (!Start(decoder, bytes, color_space)) return fail();
  const JDIMENSION width = decoder.jpeg.output_width, height = decoder.jpeg.output_height;
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (width > JDIMENSION{kMaxImageSide} || height > JDIMENSION{kMaxImageSide} ||
      pixels > most_pixels)
    return Fail(ErrorCode::kBadData, "{}: {} x {} pixels are more than {} a side or {} in all",
                source, width, height, kMaxImageSide, most_pixels);
  if (pixels > bytes.size() * kMostPixelsPerByte)
    return Fail(ErrorCode::kBadData, "{}: {} bytes cannot hold an image of {} x {}", source,
                bytes.size(), width, height);
  try {
    Image<Pixel> image(static_cast<int>(width), static_cast<int>(height));
    std::vector<JSAMPROW> rows(height);
    for (JDIMENSION y = 0; y < height; ++y)
      rows[y] = reinterpret_cast<JSAMPROW>(image.row(static_cast<int>(y)));
    if (!ReadRows(decoder, rows.data())) return fail();
    return image;
  } catch (const std::bad_alloc&) {
    return Fail(ErrorCode::kIo, "{}: its {} x {} pixels do not fit into memory", source, width,
                height);
  }
}

}  // namespace

Result<GrayImage> DecodeJpegGray(std::string_view bytes, const std::string& source) {
  return Decode<std::uint8_t>(bytes, source, JCS_GRAYSCALE, kJpegMostPixels);
}

Result<ColorImage> DecodeJpeg(std::string_view bytes, const std::string& source,
                              std::int64_t most_pixels) {
  return Decode<Rgb8>(bytes, source, JCS_RGB, static_cast<std::uint64_t>(most_pixels));
}

}  // namespace foresight
