#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "hardware/link/chunks/chunk_order.h"

namespace foresight {

/// The head's side of one stream of a scan: which chunk goes next, made when it is asked for. No
/// threads, no clock; of credits its caller takes care.
class ChunkSource {
 public:
  /// `have` is what the station said that it has.
  ChunkSource(ScanToSend source, ChunkSet have);

  /// The scan as it is now; of the same uuid. Costs nothing.
  void Update(ScanToSend source);
  /// The station has these by another way: they are not sent.
  void AddHave(const ChunkSet& have);
  void SetWishes(TransferWishes wishes) { wishes_ = std::move(wishes); }

  /// The next chunk; it counts as sent. nullopt = nothing to send now. Fails as EncodeItem does:
  /// the item is left out from then on, and the next call goes on with others.
  Result<std::optional<Chunk>> Next();

  /// Bytes of the items that are there now and may travel, and were not sent: measured for what was
  /// encoded, expected for the rest. O(items).
  std::int64_t LeftBytes() const;
  const ItemCounts& counts() const { return counts_; }

 private:
  Result<const std::vector<Chunk>*> Parts(const ItemId& id);

  ScanToSend source_;
  ItemCounts counts_;
  ChunkSet done_;
  TransferWishes wishes_;
  std::map<ItemId, std::vector<Chunk>> open_;  ///< items of which some parts were sent
};

}  // namespace foresight
