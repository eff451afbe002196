#include "hardware/link/burst/chunk_assembler.h"

#include <algorithm>

namespace foresight {
namespace {

constexpr std::size_t kAround = 256;  ///< of memory around a chunk's bytes

}  // namespace

bool ChunkAssembler::Fits(const Open& open, const ChunkFragment& fragment) {
  return open.parts == fragment.parts && open.item_crc == fragment.item_crc &&
         open.crc == fragment.crc && open.stride == fragment.stride &&
         open.bytes.size() == fragment.chunk_bytes;
}

std::size_t ChunkAssembler::Cost(const Open& open) {
  return open.bytes.size() + open.here.size() / 8 + kAround;
}

void ChunkAssembler::Remove(std::map<Key, Open>::iterator at) {
  bytes_ -= Cost(at->second);
  open_.erase(at);
}

void ChunkAssembler::MakeRoom(std::size_t bytes) {
  while (!open_.empty() && bytes_ + bytes > most_bytes_)
    Remove(std::min_element(open_.begin(), open_.end(), [](const auto& a, const auto& b) {
      return a.second.begun < b.second.begun;
    }));
}

ChunkAssembler::Open& ChunkAssembler::Begin(const Key& key, const ChunkFragment& fragment) {
  MakeRoom(fragment.chunk_bytes + fragment.Count() / 8 + kAround);
  Open& open = open_[key];
  open.parts = fragment.parts;
  open.item_crc = fragment.item_crc;
  open.crc = fragment.crc;
  open.stride = fragment.stride;
  open.bytes.resize(fragment.chunk_bytes);
  open.missing = fragment.Count();
  open.here.resize(open.missing);
  open.begun = ++begun_;
  bytes_ += Cost(open);
  return open;
}

Result<std::optional<Chunk>> ChunkAssembler::Take(const ChunkFragment& fragment) {
  const Key key{fragment.scan_tag, fragment.id};
  auto at = open_.find(key);
  if (at != open_.end() && !Fits(at->second, fragment)) {
    Remove(at);
    at = open_.end();
  }
  Open& open = at != open_.end() ? at->second : Begin(key, fragment);
  if (open.here[fragment.index]) return std::nullopt;
  open.here[fragment.index] = true;
  std::copy(fragment.bytes.begin(), fragment.bytes.end(),
            open.bytes.begin() + static_cast<std::ptrdiff_t>(fragment.index) * open.stride);
  if (--open.missing > 0) return std::nullopt;
  Chunk chunk{fragment.id, open.parts, open.item_crc, open.crc, open.bytes};
  Remove(open_.find(key));
  FORESIGHT_CHECK(CheckChunk(chunk));
  return chunk;
}

void ChunkAssembler::Forget() {
  open_.clear();
  bytes_ = 0;
}

}  // namespace foresight
