#include "hardware/link/chunks/chunk.h"

#include <algorithm>

#include "core/base/crc32c.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {

const char* ToString(ChunkKind kind) {
  switch (kind) {
    case ChunkKind::kHeader:
      return "header";
    case ChunkKind::kRig:
      return "rig";
    case ChunkKind::kTrack:
      return "track";
    case ChunkKind::kThumbnail:
      return "thumbnail";
    case ChunkKind::kCoarseCloud:
      return "coarse cloud";
    case ChunkKind::kPreview:
      return "preview";
    case ChunkKind::kRanges:
      return "ranges";
    case ChunkKind::kJpeg:
      return "JPEG";
    case ChunkKind::kIntensities:
      return "intensities";
    case ChunkKind::kImage:
      return "image";
    case ChunkKind::kDeviceHealth:
      return "device health";
    case ChunkKind::kEnd:
      return "end";
    case ChunkKind::kFineCloud:
      return "fine cloud";
  }
  return "unknown";
}

bool IsChunkKind(std::int64_t number) {
  return number >= 1 && number <= kChunkKinds;
}

std::uint32_t ChunkCrc(const Chunk& chunk) {
  const std::string ids = ItemWriter()
                              .U8(static_cast<std::uint8_t>(chunk.id.kind))
                              .U64(static_cast<std::uint64_t>(chunk.id.item))
                              .U32(static_cast<std::uint32_t>(chunk.id.part))
                              .U32(static_cast<std::uint32_t>(chunk.parts))
                              .U32(chunk.item_crc)
                              .Take();
  return Crc32c(chunk.bytes, Crc32c(ids));
}

Status CheckChunk(const Chunk& chunk) {
  const auto kind = static_cast<int>(chunk.id.kind);
  if (!IsChunkKind(kind))
    return Fail(ErrorCode::kBadData, "a chunk of kind {}, which is not known", kind);
  if (chunk.id.item < 0 || chunk.id.item >= kMaxItems)
    return Fail(ErrorCode::kBadData, "chunk of {} {}: items are from 0 to {}",
                ToString(chunk.id.kind), chunk.id.item, kMaxItems - 1);
  if (chunk.parts < 1 || chunk.parts > kMaxParts || chunk.id.part < 0 ||
      chunk.id.part >= chunk.parts)
    return Fail(ErrorCode::kBadData, "chunk of {} {}: there is no part {} of {}",
                ToString(chunk.id.kind), chunk.id.item, chunk.id.part, chunk.parts);
  if (chunk.bytes.size() > kMaxPartBytes)
    return Fail(ErrorCode::kBadData, "{}: {} bytes are more than {}", Describe(chunk),
                chunk.bytes.size(), kMaxPartBytes);
  if (chunk.crc != ChunkCrc(chunk))
    return Fail(ErrorCode::kBadData, "{}: its CRC is {:08x} and not {:08x}: damaged on the way",
                Describe(chunk), ChunkCrc(chunk), chunk.crc);
  return {};
}

std::string Describe(const Chunk& chunk) {
  std::string item = fmt::format("{} {}", ToString(chunk.id.kind), chunk.id.item);
  if (chunk.parts == 1) return item;
  return fmt::format("{}, part {} of {}", item, chunk.id.part + 1, chunk.parts);
}

Result<std::vector<Chunk>> SplitItem(const ItemId& id, std::string_view bytes) {
  const std::size_t parts =
      std::max<std::size_t>(1, (bytes.size() + kMaxPartBytes - 1) / kMaxPartBytes);
  if (parts > static_cast<std::size_t>(kMaxParts))
    return Fail(ErrorCode::kInvalidInput, "{} {}: {} bytes are more than an item may have",
                ToString(id.kind), id.item, bytes.size());
  const std::uint32_t item_crc = Crc32c(bytes);
  std::vector<Chunk> chunks(parts);
  for (std::size_t part = 0; part < parts; ++part) {
    Chunk& chunk = chunks[part];
    chunk.id = {id.kind, id.item, static_cast<std::int32_t>(part)};
    chunk.parts = static_cast<std::int32_t>(parts);
    chunk.item_crc = item_crc;
    chunk.bytes = bytes.substr(part * kMaxPartBytes, kMaxPartBytes);
    chunk.crc = ChunkCrc(chunk);
  }
  return chunks;
}

}  // namespace foresight
