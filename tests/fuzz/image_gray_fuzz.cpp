// Images of a camera: JPEG, binary PGM and PNG, told apart by their first bytes.
#include <cstdint>

#include "core/io/image_file.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  (void)DecodeJpegGray(text, "fuzz.jpg");
  const auto image = DecodeImageGray(text, "fuzz");
  if (!image) {
    Require(!image.error().message.empty(), "an error has a message");
    return 0;
  }
  Require(image->width() > 0 && image->height() > 0, "an image that was accepted has pixels");
  Require(image->width() <= 20000 && image->height() <= 20000, "no side is longer than allowed");
  return 0;
}
