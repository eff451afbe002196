// Depth maps as PNG files of 16 bits.
#include <cstdint>
#include <string_view>

#include "core/io/png.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const auto image = DecodePng16({reinterpret_cast<const char*>(bytes), size}, "fuzz.png");
  if (!image || image->size() > 10000) return 0;
  const auto encoded = EncodePng16(*image);
  Require(encoded.has_value(), "what was decoded can be encoded");
  const auto again = DecodePng16(*encoded, "again");
  Require(again.has_value() && *again == *image, "numbers survive the round trip");
  return 0;
}
