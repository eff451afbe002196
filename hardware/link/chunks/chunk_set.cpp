#include "hardware/link/chunks/chunk_set.h"

#include <algorithm>

#include "core/base/contract.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

constexpr std::uint8_t kChunkSetForm = 1;

/// Gaps and lengths, from the first one on.
void AppendNumbers(ItemWriter& writer, const NumberSet& numbers) {
  writer.Varint(numbers.IntervalCount());
  std::int64_t next = 0;
  for (const NumberSet::Interval& interval : numbers.Intervals()) {
    writer.Varint(static_cast<std::uint64_t>(interval.first - next));
    writer.Varint(static_cast<std::uint64_t>(interval.last - interval.first));
    next = interval.last + 2;  // the one in between is missing, or the two were one
  }
}

/// Numbers below `end`.
NumberSet ReadNumbers(ItemReader& reader, std::int64_t end) {
  NumberSet numbers;
  std::int64_t next = 0;
  for (std::uint64_t count = reader.Count(reader.left()); count > 0 && reader.ok(); --count) {
    const auto first =
        next + static_cast<std::int64_t>(reader.Count(static_cast<std::uint64_t>(end)));
    const auto last =
        first + static_cast<std::int64_t>(reader.Count(static_cast<std::uint64_t>(end)));
    if (last >= end) reader.SetFailed();
    if (reader.ok()) numbers.Add(NumberSet::Interval{first, last});
    next = last + 2;
  }
  return numbers;
}

ChunkKind ReadKind(ItemReader& reader) {
  const std::uint8_t kind = reader.U8();
  if (IsChunkKind(kind)) return static_cast<ChunkKind>(kind);
  reader.SetFailed();
  return ChunkKind::kHeader;
}

}  // namespace

void NumberSet::Add(const Interval& interval) {
  FORESIGHT_EXPECTS(interval.first <= interval.last, "an interval ends where it begins or later");
  Interval joined = interval;
  auto at = intervals_.upper_bound(interval.first);
  if (at != intervals_.begin() && std::prev(at)->second >= interval.first - 1) --at;
  while (at != intervals_.end() && at->first <= interval.last + 1) {
    joined.first = std::min(joined.first, at->first);
    joined.last = std::max(joined.last, at->second);
    at = intervals_.erase(at);
  }
  intervals_[joined.first] = joined.last;
}

bool NumberSet::Has(std::int64_t number) const {
  const auto at = intervals_.upper_bound(number);
  return at != intervals_.begin() && std::prev(at)->second >= number;
}

std::int64_t NumberSet::Count() const {
  std::int64_t count = 0;
  for (const auto& [first, last] : intervals_) count += last - first + 1;
  return count;
}

std::vector<NumberSet::Interval> NumberSet::Intervals() const {
  std::vector<Interval> intervals;
  for (const auto& [first, last] : intervals_) intervals.push_back({first, last});
  return intervals;
}

void ChunkSet::Add(const ItemId& id) {
  items_[id.kind].Add(id.item);
  partial_.erase(id);
}

void ChunkSet::Add(ChunkKind kind, const NumberSet::Interval& items) {
  items_[kind].Add(items);
  std::erase_if(partial_, [&](const auto& entry) {
    const ItemId& id = entry.first;
    return id.kind == kind && id.item >= items.first && id.item <= items.last;
  });
}

void ChunkSet::AddPart(const Chunk& chunk) {
  const ItemId id = chunk.id.Item();
  if (Has(id)) return;
  PartialItem& item = partial_[id];
  if (item.item_crc != chunk.item_crc) item = {chunk.item_crc, {}};
  item.parts.Add(chunk.id.part);
  if (item.parts.Count() == chunk.parts) Add(id);
}

void ChunkSet::Add(const ChunkSet& other) {
  for (const auto& [kind, numbers] : other.items_)
    for (const NumberSet::Interval& items : numbers.Intervals()) Add(kind, items);
  for (const auto& [id, theirs] : other.partial_) {
    if (Has(id)) continue;
    PartialItem& ours = partial_[id];
    if (ours.item_crc != theirs.item_crc) ours = {theirs.item_crc, {}};
    for (const NumberSet::Interval& parts : theirs.parts.Intervals()) ours.parts.Add(parts);
  }
}

bool ChunkSet::Has(const ItemId& id) const {
  return Items(id.kind).Has(id.item);
}

bool ChunkSet::HasPart(const ChunkId& id, std::uint32_t item_crc) const {
  if (Has(id.Item())) return true;
  const auto item = partial_.find(id.Item());
  return item != partial_.end() && item->second.item_crc == item_crc &&
         item->second.parts.Has(id.part);
}

const NumberSet& ChunkSet::Items(ChunkKind kind) const {
  static const NumberSet kNone;
  const auto items = items_.find(kind);
  return items == items_.end() ? kNone : items->second;
}

bool ChunkSet::empty() const {
  return items_.empty() && partial_.empty();
}

std::string ChunkSet::Encode() const {
  ItemWriter writer;
  writer.U8(kChunkSetForm).Varint(items_.size());
  for (const auto& [kind, numbers] : items_) {
    writer.U8(static_cast<std::uint8_t>(kind));
    AppendNumbers(writer, numbers);
  }
  writer.Varint(partial_.size());
  for (const auto& [id, item] : partial_) {
    writer.U8(static_cast<std::uint8_t>(id.kind)).Varint(static_cast<std::uint64_t>(id.item));
    writer.U32(item.item_crc);
    AppendNumbers(writer, item.parts);
  }
  return writer.Take();
}

Result<ChunkSet> ChunkSet::Decode(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kChunkSetForm)
    return Fail(ErrorCode::kBadData, "set of chunks: form is not known");
  ChunkSet set;
  for (std::uint64_t kinds = reader.Count(kChunkKinds); kinds > 0 && reader.ok(); --kinds) {
    const ChunkKind kind = ReadKind(reader);
    for (const auto& interval : ReadNumbers(reader, kMaxItems).Intervals())
      set.items_[kind].Add(interval);
  }
  for (std::uint64_t items = reader.Count(reader.left()); items > 0 && reader.ok(); --items) {
    const ChunkKind kind = ReadKind(reader);
    const ItemId id{kind, static_cast<std::int64_t>(reader.Count(kMaxItems - 1))};
    PartialItem item;
    item.item_crc = reader.U32();
    item.parts = ReadNumbers(reader, kMaxParts);
    if (reader.ok() && !item.parts.empty() && !set.Has(id)) set.partial_[id] = std::move(item);
  }
  FORESIGHT_CHECK(reader.Finish("set of chunks"));
  return set;
}

}  // namespace foresight
