#include <fmt/format.h>

#include <cstdio>
// libjpeg's header needs size_t and FILE, but includes neither.
#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <cstdlib>
#include <vector>

#include "core/base/gray_image.h"
#include "core/io/image_limits.h"
#include "core/io/jpeg.h"

namespace foresight {
namespace {

/// See Decoder in jpeg_decode.cpp: libjpeg leaves by longjmp.
struct JpegEncoder {
  JpegEncoder() {
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = OnError;
    jpeg.client_data = this;
  }
  ~JpegEncoder() {
    if (created) jpeg_destroy_compress(&jpeg);
    std::free(bytes);
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  [[noreturn]] static void OnError(j_common_ptr common) {
    auto* encoder = static_cast<JpegEncoder*>(common->client_data);
    common->err->format_message(common, encoder->message.data());
    std::longjmp(encoder->jump, 1);
  }

  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf jump{};
  bool created = false;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  std::array<char, JMSG_LENGTH_MAX> message{};
};

struct JpegLayout {
  int components;
  J_COLOR_SPACE color_space;
};

bool WriteRows(JpegEncoder& encoder, int width, int height, int quality, const JpegLayout& layout,
               JSAMPROW* rows) {
  if (setjmp(encoder.jump) != 0) return false;
  jpeg_create_compress(&encoder.jpeg);
  encoder.created = true;
  encoder.jpeg.client_data = &encoder;
  jpeg_mem_dest(&encoder.jpeg, &encoder.bytes, &encoder.size);
  encoder.jpeg.image_width = static_cast<JDIMENSION>(width);
  encoder.jpeg.image_height = static_cast<JDIMENSION>(height);
  encoder.jpeg.input_components = layout.components;
  encoder.jpeg.in_color_space = layout.color_space;
  jpeg_set_defaults(&encoder.jpeg);
  jpeg_set_quality(&encoder.jpeg, quality, TRUE);
  // The usual tables of codes cost a tenth of a small image.
  encoder.jpeg.optimize_coding = TRUE;
  jpeg_start_compress(&encoder.jpeg, TRUE);
  while (encoder.jpeg.next_scanline < encoder.jpeg.image_height)
    jpeg_write_scanlines(&encoder.jpeg, rows + encoder.jpeg.next_scanline,
                         encoder.jpeg.image_height - encoder.jpeg.next_scanline);
  jpeg_finish_compress(&encoder.jpeg);
  return true;
}

template <class Pixel>
Result<std::string> Encode(const Image<Pixel>& image, int quality, const JpegLayout& layout) {
  JpegEncoder encoder;
  std::vector<JSAMPROW> rows;
  // libjpeg's interface is not const correct; it does not change the rows.
  for (int y = 0; y < image.height(); ++y)
    rows.push_back(reinterpret_cast<JSAMPROW>(const_cast<Pixel*>(image.row(y))));
  if (!WriteRows(encoder, image.width(), image.height(), quality, layout, rows.data()))
    return Fail(ErrorCode::kIo, "JPEG encoder: {}", encoder.message.data());
  return std::string(reinterpret_cast<const char*>(encoder.bytes), encoder.size);
}

}  // namespace

Result<std::string> EncodeJpeg(const ColorImage& image, int quality) {
  if (quality < 1 || quality > 100)
    return Fail(ErrorCode::kInvalidOptions, "quality {} of a JPEG is not from 1 to 100", quality);
  if (image.empty() || image.width() > kMaxImageSide || image.height() > kMaxImageSide)
    return Fail(ErrorCode::kInvalidInput, "an image of {} x {} cannot become a JPEG", image.width(),
                image.height());
  if (!IsGray(image)) return Encode(image, quality, {3, JCS_RGB});
  return Encode(RedOf(image), quality, {1, JCS_GRAYSCALE});
}

}  // namespace foresight
