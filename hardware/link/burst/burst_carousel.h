#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "hardware/link/chunks/chunk_order.h"

namespace foresight {

/// What a head sends of a scan on a path that nobody answers on: all that the station does not have
/// yet, in the order of its use, round after round. Items are encoded ahead by whoever has the time
/// (NextToEncode, Add), so that a burst waits for nothing. No threads, no clock.
class BurstCarousel {
 public:
  /// Of encoded items that wait; more are encoded when the station has some of them.
  static constexpr std::size_t kUsualBytes = std::size_t{192} << 20;

  BurstCarousel(ScanToSend source, ChunkSet have, std::size_t most_bytes = kUsualBytes);

  /// The scan as it is now; of the same uuid.
  void Update(ScanToSend source);
  void SetPreferences(TransferPreferences preferences) { preferences_ = std::move(preferences); }
  /// What the station has now. It replaces what it had: what it could not read comes again.
  void SetHave(ChunkSet have);

  const ScanToSend& source() const { return source_; }
  /// The item that is to be encoded next; nullopt = all are, or they take enough memory.
  std::optional<ItemId> NextToEncode() const;
  void Add(const ItemId& id, std::vector<Chunk> parts);
  /// The item cannot be encoded.
  void LeaveOut(const ItemId& id) { left_out_.Add(id); }

  /// The next chunk of this round, of those that are encoded; null = the round is over.
  std::shared_ptr<const Chunk> Next();
  void BeginRound();
  /// Of encoded items.
  std::size_t bytes() const { return bytes_; }

 private:
  using Parts = std::shared_ptr<const std::vector<Chunk>>;

  ScanToSend source_;
  ItemCounts counts_;
  const std::size_t most_bytes_;
  TransferPreferences preferences_;
  ChunkSet have_;
  ChunkSet left_out_;
  ChunkSet round_;  ///< what the station has, and what this round sent or had to pass over
  std::map<ItemId, Parts> encoded_;
  std::size_t bytes_ = 0;
  Parts open_;  ///< of the item that is being sent
  std::size_t part_ = 0;
};

}  // namespace foresight
