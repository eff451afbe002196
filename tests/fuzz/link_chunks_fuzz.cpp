// Chunks as they come from a head, each message behind its length (u16, little-endian). The first
// byte says whether they come as they are (0), with checksums that are set right as a head gone mad
// would (1), or whether what follows are the preferences that a station sends up (2).
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/crc32c.h"
#include "hardware/link/chunks/scan_builder.h"
#include "hardware/link/protocol/chunk_messages.h"
#include "tests/fuzz/require.h"

namespace foresight {
namespace {

void TakeChunk(link::Chunk message, bool sealed, ScanBuilder& builder) {
  auto chunk = FromMessage(std::move(message));
  if (!chunk) return;
  if (sealed) {
    if (chunk->parts == 1) chunk->item_crc = Crc32c(chunk->bytes);
    chunk->crc = ChunkCrc(*chunk);
  }
  const bool good = CheckChunk(*chunk).has_value();
  const bool taken = builder.Take(*chunk).has_value();
  Require(good || !taken, "a damaged chunk is not taken");
  Require(!taken || builder.Have().HasPart(chunk->id, chunk->item_crc), "what was taken is there");
}

void TryPreferences(const link::TransferPreferences& message) {
  const TransferPreferences preferences = FromMessage(message);
  ScanToSend source;
  for (std::int64_t seq : {0, 1, 5}) {
    LidarLine line;
    line.seq = seq;
    source.scan.lines.push_back(line);
  }
  const ItemCounts counts = ItemsOf(source);
  ChunkSet done;
  for (int i = 0; i < 100; ++i) {
    const auto next = NextItem(source, counts, done, preferences);
    if (!next) return;
    Require(!done.Has(*next) && next->item >= 0 && next->item < counts[next->kind],
            "an item that goes next is one of the scan's and was not sent");
    done.Add(*next);
  }
  Require(false, "a scan has an end whatever a station prefers");
}

void TryChunks(std::span<const std::uint8_t> left, bool sealed) {
  ScanBuilder builder("00000000-0000-4000-8000-000000000001");
  while (left.size() >= 2) {
    const std::size_t length = std::min<std::size_t>(left[0] | left[1] << 8, left.size() - 2);
    link::Chunk message;
    if (message.ParseFromArray(left.data() + 2, static_cast<int>(length)))
      TakeChunk(std::move(message), sealed, builder);
    left = left.subspan(2 + length);
  }
  const auto again = ChunkSet::Decode(builder.Have().Encode());
  Require(again && *again == builder.Have(), "what is there can be told to the head");
}

}  // namespace
}  // namespace foresight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  if (size == 0) return 0;
  if (bytes[0] < 2) {
    TryChunks({bytes + 1, size - 1}, bytes[0] == 1);
    return 0;
  }
  link::TransferPreferences preferences;
  if (preferences.ParseFromArray(bytes + 1, static_cast<int>(size - 1)))
    TryPreferences(preferences);
  return 0;
}
