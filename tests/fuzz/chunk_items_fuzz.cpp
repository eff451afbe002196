// Items of a scan from a link: the first byte is the kind, the rest the item; kind 0 is a set of
// chunks, as a station sends it.
#include <cstdint>
#include <string_view>

#include "hardware/link/chunks/scan_builder.h"
#include "tests/fuzz/require.h"

namespace foresight {
namespace {

void TrySet(std::string_view bytes) {
  const auto set = ChunkSet::Decode(bytes);
  if (!set) return;
  const auto same = ChunkSet::Decode(set->Encode());
  Require(same && *same == *set, "a set survives being sent");
}

void TryItem(ChunkKind kind, std::string_view bytes) {
  const auto parts = SplitItem({kind, 0}, bytes);
  if (!parts) return;
  ScanBuilder builder("00000000-0000-4000-8000-000000000001");
  bool taken = true;
  for (const Chunk& part : *parts) taken = builder.Take(part).has_value();
  Require(builder.Have().Has({kind, 0}) == taken, "what was refused is not there");
  if (const auto cloud = builder.Cloud()) Require(cloud->points.lines > 0, "a cloud has lines");
  Require(!builder.Whole(), "one item is no scan");
}

}  // namespace
}  // namespace foresight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view item(reinterpret_cast<const char*>(bytes) + 1, size - 1);
  if (foresight::IsChunkKind(bytes[0]))
    foresight::TryItem(static_cast<foresight::ChunkKind>(bytes[0]), item);
  else
    foresight::TrySet(item);
  return 0;
}
