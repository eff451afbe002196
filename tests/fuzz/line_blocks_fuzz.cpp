// Blocks of lidar lines from a link: the first byte says of what, the rest is the item.
#include <cstdint>
#include <string_view>

#include "hardware/link/chunks/line_blocks.h"
#include "tests/fuzz/require.h"

namespace foresight {
namespace {

std::vector<const LidarLine*> Pointers(const std::vector<LidarLine>& lines) {
  std::vector<const LidarLine*> pointers;
  for (const LidarLine& line : lines) pointers.push_back(&line);
  return pointers;
}

void TryRanges(std::string_view bytes) {
  const auto lines = DecodeRanges(bytes);
  if (!lines) return;
  const auto again = EncodeRanges(Pointers(*lines));
  Require(again.has_value(), "what was decoded can be encoded");
  const auto same = DecodeRanges(*again);
  Require(same && *same == *lines, "encoding loses nothing");
}

void TryIntensities(std::string_view bytes) {
  const auto rows = DecodeIntensities(bytes);
  if (!rows) return;
  std::vector<LidarLine> lines(rows->size());
  for (std::size_t i = 0; i < rows->size(); ++i) lines[i].intensity = (*rows)[i];
  const auto again = EncodeIntensities(Pointers(lines));
  Require(again.has_value(), "what was decoded can be encoded");
  const auto same = DecodeIntensities(*again);
  Require(same && *same == *rows, "encoding loses nothing");
}

}  // namespace
}  // namespace foresight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view item(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  if ((bytes[0] & 1) == 0)
    foresight::TryRanges(item);
  else
    foresight::TryIntensities(item);
  return 0;
}
