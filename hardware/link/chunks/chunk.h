#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace foresight {

/// What a part of a scan is (ADR 0015, docs/protocols.md). The numbers are part of the protocol and
/// of spools: none is ever given to something else.
enum class ChunkKind : std::uint8_t {
  kHeader = 1,  ///< one item: everything of a scan that is known when it starts, but the rig
  kRig = 2,     ///< one item: the rig's YAML
  kTrack = 3,   ///< blocks of kSamplesPerBlock motor samples
  kThumbnail =
      4,  ///< one a frame: JPEG of at most 161 pixels a side, with what is known of the frame
  kCoarseCloud = 5,    ///< one a block of 64 lines: every 32nd line, every 8th beam
  kPreview = 6,        ///< one a frame: JPEG of at most 322 pixels a side
  kRanges = 7,         ///< blocks of kLinesPerBlock lines, without intensities
  kJpeg = 8,           ///< one a frame: JPEG of its full size
  kIntensities = 9,    ///< blocks of kLinesPerBlock lines
  kImage = 10,         ///< one a frame, lossless
  kDeviceHealth = 11,  ///< one item: JSON
  kEnd = 12,           ///< one item: how the scan ended, number of items, digest
  kFineCloud = 13,     ///< as kCoarseCloud: every 4th line, every 2nd beam
};
inline constexpr int kChunkKinds = 13;
/// "header", "rig", ...; "unknown".
const char* ToString(ChunkKind kind);
/// Of a number that came over a wire.
bool IsChunkKind(std::int64_t number);

inline constexpr int kLinesPerBlock = 8;
inline constexpr int kSamplesPerBlock = 64;

/// An item of a scan: kind and number, from 0.
struct ItemId {
  ChunkKind kind = ChunkKind::kHeader;
  std::int64_t item = 0;
  auto operator<=>(const ItemId&) const = default;  // NOLINT: the check sees a 0 of the compiler's
};

/// A part of an item, from 0.
struct ChunkId {
  ChunkKind kind = ChunkKind::kHeader;
  std::int64_t item = 0;
  std::int32_t part = 0;
  ItemId Item() const { return {kind, item}; }
  auto operator<=>(const ChunkId&) const = default;  // NOLINT: as above
};

/// What travels: one part of an item.
struct Chunk {
  ChunkId id;
  std::int32_t parts = 1;      ///< of the whole item
  std::uint32_t item_crc = 0;  ///< CRC-32C of the whole item
  std::uint32_t crc = 0;       ///< ChunkCrc
  std::string bytes;
  bool operator==(const Chunk&) const = default;
};

inline constexpr std::size_t kMaxPartBytes = 60'000;
inline constexpr std::int32_t kMaxParts = 4'000;                  ///< of an item: 240 MB
inline constexpr std::int64_t kMaxItems = std::int64_t{1} << 24;  ///< of a kind

/// CRC-32C over all other members of the chunk.
std::uint32_t ChunkCrc(const Chunk& chunk);

/// Whether the chunk is what it says: numbers in their bounds, its CRC. Fails with kBadData.
Status CheckChunk(const Chunk& chunk);

/// "ranges 12, part 3 of 4", for messages.
std::string Describe(const Chunk& chunk);

/// All parts of an item, ready to be sent; an empty item is one empty part. An item longer than
/// kMaxParts parts fails with kInvalidInput.
Result<std::vector<Chunk>> SplitItem(const ItemId& id, std::string_view bytes);

}  // namespace foresight
