#include "hardware/link/protocol/chunk_messages.h"

#include <algorithm>
#include <utility>

namespace foresight {
namespace {

constexpr int kMostImagesFirst = 1000;

}  // namespace

link::Chunk ToMessage(Chunk chunk) {
  link::Chunk message;
  link::ChunkId& id = *message.mutable_id();
  id.set_kind(static_cast<int>(chunk.id.kind));
  id.set_item(chunk.id.item);
  id.set_part(chunk.id.part);
  message.set_parts(chunk.parts);
  message.set_item_crc(chunk.item_crc);
  message.set_crc(chunk.crc);
  message.set_bytes(std::move(chunk.bytes));
  return message;
}

std::optional<Chunk> FromMessage(link::Chunk&& message) {
  if (!IsChunkKind(message.id().kind())) return std::nullopt;
  Chunk chunk;
  chunk.id.kind = static_cast<ChunkKind>(message.id().kind());
  chunk.id.item = message.id().item();
  chunk.id.part = message.id().part();
  chunk.parts = message.parts();
  chunk.item_crc = message.item_crc();
  chunk.crc = message.crc();
  chunk.bytes = std::move(*message.mutable_bytes());
  return chunk;
}

TransferPreferences FromMessage(const link::TransferPreferences& message) {
  TransferPreferences preferences;
  preferences.bytes_per_s = static_cast<double>(std::max<std::int64_t>(0, message.bytes_per_s()));
  if (message.has_lines_first() && message.lines_first().first() <= message.lines_first().last())
    preferences.lines_first =
        NumberSet::Interval{message.lines_first().first(), message.lines_first().last()};
  if (message.images_first_size() <= kMostImagesFirst)
    preferences.images_first.assign(message.images_first().begin(), message.images_first().end());
  return preferences;
}

}  // namespace foresight
