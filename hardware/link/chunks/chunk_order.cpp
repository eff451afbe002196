#include "hardware/link/chunks/chunk_order.h"

#include <algorithm>
#include <array>
#include <bit>

#include "hardware/link/chunks/cloud_items.h"

namespace foresight {
namespace {

/// From what an operator needs first to what only the record needs. Coarse clouds go with the
/// thumbnails, images on request before the track.
constexpr std::array kOrder = {
    ChunkKind::kHeader, ChunkKind::kRig,          ChunkKind::kEnd,         ChunkKind::kThumbnail,
    ChunkKind::kTrack,  ChunkKind::kDeviceHealth, ChunkKind::kPreview,     ChunkKind::kFineCloud,
    ChunkKind::kRanges, ChunkKind::kJpeg,         ChunkKind::kIntensities, ChunkKind::kImage};
static_assert(kOrder.size() == kChunkKinds - 1);

bool TravelsOnAThinPath(ChunkKind kind) {
  switch (kind) {
    case ChunkKind::kHeader:
    case ChunkKind::kRig:
    case ChunkKind::kEnd:
    case ChunkKind::kThumbnail:
    case ChunkKind::kCoarseCloud:
      return true;
    default:
      return false;
  }
}

bool Travels(ChunkKind kind, double bytes_per_s) {
  const bool known = bytes_per_s > 0.0;
  if (known && bytes_per_s < kThinBytesPerS) return TravelsOnAThinPath(kind);
  if (kind == ChunkKind::kFineCloud) return known && bytes_per_s < kFineCloudBelowBytesPerS;
  return true;
}

bool HasAllRanges(const ItemCounts& counts, const ChunkSet& done, std::int64_t cloud_block) {
  constexpr std::int64_t kBlocks = kLinesPerCloudBlock / kLinesPerBlock;
  const std::int64_t begin = cloud_block * kBlocks;
  const std::int64_t end = std::min(begin + kBlocks, counts[ChunkKind::kRanges]);
  for (std::int64_t block = begin; block < end; ++block)
    if (!done.Has({ChunkKind::kRanges, block})) return false;
  return begin < end;
}

/// Whether something better than the item has gone already.
bool IsSuperfluous(const ItemId& id, const ItemCounts& counts, const ChunkSet& done) {
  const auto has = [&](ChunkKind kind) { return done.Has({kind, id.item}); };
  switch (id.kind) {
    case ChunkKind::kThumbnail:
      return has(ChunkKind::kPreview) || has(ChunkKind::kJpeg) || has(ChunkKind::kImage);
    case ChunkKind::kPreview:
      return has(ChunkKind::kJpeg) || has(ChunkKind::kImage);
    case ChunkKind::kJpeg:
      return has(ChunkKind::kImage);
    case ChunkKind::kCoarseCloud:
      return has(ChunkKind::kFineCloud) || HasAllRanges(counts, done, id.item);
    case ChunkKind::kFineCloud:
      return HasAllRanges(counts, done, id.item);
    default:
      return false;
  }
}

bool IsLeft(const ItemId& id, const ItemCounts& counts, const ChunkSet& done) {
  return !done.Has(id) && !IsSuperfluous(id, counts, done);
}

/// Index of the first line that has the seq, or a later one.
std::int64_t LineOfSeq(const Scan& scan, std::int64_t seq) {
  const auto at =
      std::lower_bound(scan.lines.begin(), scan.lines.end(), seq,
                       [](const LidarLine& line, std::int64_t s) { return line.seq < s; });
  return at - scan.lines.begin();
}

/// Blocks of lines that hold a line of the region; {0, -1} where none does.
NumberSet::Interval BlocksOfRegion(const Scan& scan, const NumberSet::Interval& seqs) {
  if (seqs.last < seqs.first) return {0, -1};
  const std::int64_t begin = LineOfSeq(scan, seqs.first);
  const std::int64_t end = seqs.last == INT64_MAX ? static_cast<std::int64_t>(scan.lines.size())
                                                  : LineOfSeq(scan, seqs.last + 1);
  if (begin >= end) return {0, -1};
  return {begin / kLinesPerBlock, (end - 1) / kLinesPerBlock};
}

/// The first block of [first, last] that is left, in bit-reversed order: every prefix covers all of
/// them evenly.
std::optional<ItemId> InReversedOrder(ChunkKind kind, std::int64_t first, std::int64_t last,
                                      const ChunkSet& done) {
  const auto count = static_cast<std::uint64_t>(std::max<std::int64_t>(0, last - first + 1));
  const std::uint64_t size = std::bit_ceil(count);
  for (std::uint64_t i = 0, place = 0; i < size; ++i) {
    if (place < count) {
      const ItemId id{kind, first + static_cast<std::int64_t>(place)};
      if (!done.Has(id)) return id;
    }
    // Adds 1 at the highest bit and carries downwards.
    std::uint64_t bit = size >> 1;
    for (; bit > 0 && (place & bit) != 0; bit >>= 1) place ^= bit;
    place |= bit;
  }
  return std::nullopt;
}

std::optional<ItemId> NextBlock(ChunkKind kind, const ScanToSend& source, const ItemCounts& counts,
                                const ChunkSet& done, const TransferPreferences& preferences) {
  const std::int64_t last = counts[kind] - 1;
  if (done.Count(kind) > last) return std::nullopt;
  if (preferences.lines_first) {
    const NumberSet::Interval region = BlocksOfRegion(source.scan, *preferences.lines_first);
    if (auto id = InReversedOrder(kind, region.first, std::min(region.last, last), done)) return id;
  }
  return InReversedOrder(kind, 0, last, done);
}

std::optional<ItemId> NextOfKind(ChunkKind kind, const ItemCounts& counts, const ChunkSet& done) {
  if (done.Count(kind) >= counts[kind]) return std::nullopt;
  for (std::int64_t item = 0; item < counts[kind]; ++item)
    if (IsLeft({kind, item}, counts, done)) return ItemId{kind, item};
  return std::nullopt;
}

/// One after the other: neither many images nor many lines make the operator wait for the others.
std::optional<ItemId> NextSmallView(const ItemCounts& counts, const ChunkSet& done) {
  const auto cloud = NextOfKind(ChunkKind::kCoarseCloud, counts, done);
  const auto thumbnail = NextOfKind(ChunkKind::kThumbnail, counts, done);
  if (!cloud || !thumbnail) return cloud ? cloud : thumbnail;
  const bool clouds_are_ahead =
      done.Count(ChunkKind::kCoarseCloud) > done.Count(ChunkKind::kThumbnail);
  return clouds_are_ahead ? thumbnail : cloud;
}

std::optional<ItemId> NextFor(ChunkKind kind, const ScanToSend& source, const ItemCounts& counts,
                              const ChunkSet& done, const TransferPreferences& preferences) {
  if (kind == ChunkKind::kThumbnail) return NextSmallView(counts, done);
  if (kind == ChunkKind::kRanges || kind == ChunkKind::kIntensities)
    return NextBlock(kind, source, counts, done, preferences);
  return NextOfKind(kind, counts, done);
}

std::optional<ItemId> NextRequestedImage(const ItemCounts& counts, const ChunkSet& done,
                                         const TransferPreferences& preferences) {
  for (const std::int64_t position : preferences.images_first) {
    const ItemId id{ChunkKind::kImage, position};
    if (position >= 0 && position < counts[id.kind] && !done.Has(id)) return id;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ItemId> NextItem(const ScanToSend& source, const ItemCounts& counts,
                               const ChunkSet& done, const TransferPreferences& preferences) {
  for (const ChunkKind kind : kOrder) {
    if (kind == ChunkKind::kTrack)
      if (auto id = NextRequestedImage(counts, done, preferences)) return id;
    if (!Travels(kind, preferences.bytes_per_s)) continue;
    if (auto id = NextFor(kind, source, counts, done, preferences)) return id;
  }
  return std::nullopt;
}

bool MayTravel(const ItemId& id, const ItemCounts& counts, const ChunkSet& done,
               const TransferPreferences& preferences) {
  if (!IsLeft(id, counts, done)) return false;
  if (Travels(id.kind, preferences.bytes_per_s)) return true;
  return id.kind == ChunkKind::kImage &&
         std::count(preferences.images_first.begin(), preferences.images_first.end(), id.item) > 0;
}

}  // namespace foresight
