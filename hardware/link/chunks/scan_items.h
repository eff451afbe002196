#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/sensor/scan.h"
#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// What a head can send of a scan. A copy costs nothing, as a scan's.
struct ScanToSend {
  Scan scan;
  /// JSON of HealthReport (health_item.h); empty = none. It is offered when the scan has ended.
  std::string health_json;
};

/// How many items of each kind there are: those numbered 0 to count - 1.
class ItemCounts {
 public:
  std::int64_t operator[](ChunkKind kind) const { return counts_[Index(kind)]; }
  std::int64_t& operator[](ChunkKind kind) { return counts_[Index(kind)]; }
  bool operator==(const ItemCounts&) const = default;

 private:
  static std::size_t Index(ChunkKind kind) { return static_cast<std::size_t>(kind) - 1; }
  std::array<std::int64_t, kChunkKinds> counts_{};
};

/// The items that the scan has now. An item is there when nothing that comes later changes it: a
/// block when it is full, or the scan has ended. O(1).
ItemCounts ItemsOf(const ScanToSend& source);

/// The bytes of an item, a pure function of scan and id: a head that was restarted makes them
/// again. Fails with kState where the scan does not have the item (yet), with kInvalidInput where a
/// value cannot be sent (e.g. 100,001 beams). 0.1 ms a block of lines; a JPEG 10 ms, an image 20
/// ms; the end reads the whole scan for its digest: 0.1 s for 12 images.
Result<std::string> EncodeItem(const ScanToSend& source, const ItemId& id);

/// An estimate of the item's bytes, from its sizes alone.
std::int64_t ExpectedBytes(const ScanToSend& source, const ItemId& id);

}  // namespace foresight
