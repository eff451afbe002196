// PNG images of every kind.
#include <cstdint>

#include "core/io/png.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  (void)DecodePngGray(text, "fuzz.png");
  const auto image = DecodePng(text, "fuzz.png");
  if (!image || image->size() > 10000) return 0;
  const auto encoded = EncodePng(*image);
  Require(encoded.has_value(), "what was decoded can be encoded");
  const auto again = DecodePng(*encoded, "again");
  Require(again.has_value() && *again == *image, "PNG is lossless");
  return 0;
}
