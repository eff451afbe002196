#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hardware/link/chunks/chunk.h"

namespace foresight {

/// Whole numbers as intervals.
class NumberSet {
 public:
  struct Interval {
    std::int64_t first = 0;
    std::int64_t last = 0;  ///< inclusive
    bool operator==(const Interval&) const = default;
  };

  /// O(log intervals) where the number extends or lies in one.
  void Add(std::int64_t number) { Add(Interval{number, number}); }
  /// @pre first <= last
  void Add(const Interval& interval);
  bool Has(std::int64_t number) const;
  bool empty() const { return intervals_.empty(); }
  std::int64_t Count() const;
  std::vector<Interval> Intervals() const;
  std::size_t IntervalCount() const { return intervals_.size(); }

  bool operator==(const NumberSet&) const = default;

 private:
  std::map<std::int64_t, std::int64_t> intervals_;  ///< first -> last; neither touching nor empty
};

/// Which chunks of a scan are there: whole items by kind, and parts of items that are not whole
/// yet.
class ChunkSet {
 public:
  struct PartialItem {
    std::uint32_t item_crc = 0;  ///< the parts belong to an item with these bytes
    NumberSet parts;
    bool operator==(const PartialItem&) const = default;
  };

  /// The whole item is there.
  void Add(const ItemId& id);
  void Add(ChunkKind kind, const NumberSet::Interval& items);
  /// One part is there; the last missing one of `parts` makes the item whole. Parts of an item
  /// whose CRC differs are forgotten: the item was made anew.
  void AddPart(const Chunk& chunk);
  /// All of the other set.
  void Add(const ChunkSet& other);
  void ForgetParts(const ItemId& id) { partial_.erase(id); }

  bool Has(const ItemId& id) const;
  bool HasPart(const ChunkId& id, std::uint32_t item_crc) const;
  std::int64_t Count(ChunkKind kind) const { return Items(kind).Count(); }
  const NumberSet& Items(ChunkKind kind) const;
  const std::map<ItemId, PartialItem>& partial() const { return partial_; }
  bool empty() const;

  /// As few bytes, to be sent: some 4 an interval.
  std::string Encode() const;
  /// Fails with kBadData; memory in proportion to the bytes.
  static Result<ChunkSet> Decode(std::string_view bytes);

  bool operator==(const ChunkSet&) const = default;

 private:
  std::map<ChunkKind, NumberSet> items_;
  std::map<ItemId, PartialItem> partial_;
};

}  // namespace foresight
