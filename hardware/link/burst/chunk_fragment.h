#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// A piece of a chunk that fits a datagram. All pieces of a chunk but the last have `stride` bytes.
struct ChunkFragment {
  std::uint64_t scan_tag = 0;  ///< BurstScanTag of the scan
  ChunkId id;
  std::int32_t parts = 1;
  std::uint32_t item_crc = 0;
  std::uint32_t crc = 0;
  std::uint32_t chunk_bytes = 0;
  std::uint32_t stride = 1;
  std::uint32_t index = 0;
  std::span<const std::uint8_t> bytes;

  std::uint32_t Count() const;
};

/// What stands before a fragment's bytes.
inline constexpr std::size_t kFragmentHeadBytes = 33;
/// Of a fragment, so that the note of which are there stays small.
inline constexpr std::uint32_t kLeastStride = 64;

/// Names a scan in few bytes: the first 8 of the SHA-256 of its id.
std::uint64_t BurstScanTag(const std::string& scan_id);

/// Of a chunk in fragments with at most `stride` bytes; an empty chunk is one empty fragment.
std::uint32_t FragmentCount(const Chunk& chunk, std::uint32_t stride);
/// `content` becomes the fragment. @pre index < FragmentCount
void WriteFragment(std::uint64_t scan_tag, const Chunk& chunk, std::uint32_t stride,
                   std::uint32_t index, std::vector<std::uint8_t>& content);
/// Its bytes lie in `content`. Fails with kBadData: a number is out of its bounds, or the bytes are
/// not as many as the numbers say.
Result<ChunkFragment> ReadFragment(std::span<const std::uint8_t> content);

}  // namespace foresight
