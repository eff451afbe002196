#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "hardware/link/chunks/chunk_order.h"

namespace foresight {

using SharedParts = std::shared_ptr<const std::vector<Chunk>>;

/// An item, encoded and split. Fails as EncodeItem does.
Result<SharedParts> EncodeParts(const ScanToSend& source, const ItemId& id);

/// The head's side of one stream of a scan: which chunk goes next, made when it is asked for. No
/// threads, no clock; of credits its caller takes care.
class ChunkSource {
 public:
  /// Where the parts of items come from: EncodeParts, or what keeps them.
  using PartsOf = std::function<Result<SharedParts>(const ScanToSend&, const ItemId&)>;

  /// `have` is what the station said that it has.
  ChunkSource(ScanToSend source, ChunkSet have, PartsOf parts_of = EncodeParts);

  /// The scan as it is now; of the same uuid. Costs nothing.
  void Update(ScanToSend source);
  /// The station has these by another way: they are not sent.
  void AddHave(const ChunkSet& have);
  void SetPreferences(TransferPreferences preferences) { preferences_ = std::move(preferences); }

  /// The next chunk; it counts as sent. nullopt = nothing to send now. Fails as EncodeItem does:
  /// the item is left out from then on, and the next call goes on with others.
  Result<std::optional<Chunk>> Next();

  /// Bytes of the items that are there now and may travel, and were not sent: measured for what was
  /// encoded, expected for the rest. O(items).
  std::int64_t LeftBytes() const;
  const ItemCounts& counts() const { return counts_; }

 private:
  Result<SharedParts> Parts(const ItemId& id);

  ScanToSend source_;
  ItemCounts counts_;
  ChunkSet done_;
  TransferPreferences preferences_;
  PartsOf parts_of_;
  std::map<ItemId, SharedParts> open_;  ///< items of which some parts were sent
};

}  // namespace foresight
