#include "hardware/link/chunks/chunk_source.h"

#include <algorithm>

#include "core/base/contract.h"

namespace foresight {

Result<SharedParts> EncodeParts(const ScanToSend& source, const ItemId& id) {
  FORESIGHT_TRY(const std::string bytes, EncodeItem(source, id));
  FORESIGHT_TRY(std::vector<Chunk> parts, SplitItem(id, bytes));
  return std::make_shared<const std::vector<Chunk>>(std::move(parts));
}

ChunkSource::ChunkSource(ScanToSend source, ChunkSet have, PartsOf parts_of)
    : source_(std::move(source)),
      counts_(ItemsOf(source_)),
      done_(std::move(have)),
      parts_of_(std::move(parts_of)) {}

void ChunkSource::Update(ScanToSend source) {
  FORESIGHT_EXPECTS(source.scan.uuid == source_.scan.uuid, "a stream is of one scan");
  source_ = std::move(source);
  counts_ = ItemsOf(source_);
}

void ChunkSource::AddHave(const ChunkSet& have) {
  done_.Add(have);
  std::erase_if(open_, [&](const auto& item) { return done_.Has(item.first); });
}

Result<std::optional<Chunk>> ChunkSource::Next() {
  while (const auto id = NextItem(source_, counts_, done_, preferences_)) {
    const auto parts = Parts(*id);
    if (!parts) {
      done_.Add(*id);
      return tl::unexpected(parts.error());
    }
    const auto missing = std::find_if((*parts)->begin(), (*parts)->end(), [&](const Chunk& chunk) {
      return !done_.HasPart(chunk.id, chunk.item_crc);
    });
    if (missing == (*parts)->end()) {
      // The station had all parts when it said what it has.
      done_.Add(*id);
      open_.erase(*id);
      continue;
    }
    Chunk chunk = *missing;
    done_.AddPart(chunk);
    if (done_.Has(*id)) open_.erase(*id);
    return chunk;
  }
  return std::nullopt;
}

Result<SharedParts> ChunkSource::Parts(const ItemId& id) {
  const auto open = open_.find(id);
  if (open != open_.end()) return open->second;
  FORESIGHT_TRY(SharedParts parts, parts_of_(source_, id));
  return open_[id] = std::move(parts);
}

std::int64_t ChunkSource::LeftBytes() const {
  std::int64_t bytes = 0;
  for (int number = 1; number <= kChunkKinds; ++number) {
    const auto kind = static_cast<ChunkKind>(number);
    for (std::int64_t item = 0; item < counts_[kind]; ++item) {
      const ItemId id{kind, item};
      if (!MayTravel(id, counts_, done_, preferences_)) continue;
      const auto open = open_.find(id);
      if (open == open_.end()) {
        bytes += ExpectedBytes(source_, id);
        continue;
      }
      for (const Chunk& chunk : *open->second)
        if (!done_.HasPart(chunk.id, chunk.item_crc))
          bytes += static_cast<std::int64_t>(chunk.bytes.size());
    }
  }
  return bytes;
}

}  // namespace foresight
