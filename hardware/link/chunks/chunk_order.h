#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hardware/link/chunks/chunk_set.h"
#include "hardware/link/chunks/scan_items.h"

namespace foresight {

/// What the station wants of a transfer, besides all of it.
struct TransferPreferences {
  /// Of the path; 0 = not known, as fast as it goes.
  double bytes_per_s = 0.0;
  /// seq of the lines of the region of interest, first and last.
  std::optional<NumberSet::Interval> lines_first;
  /// Positions of frames whose lossless image goes before lines.
  std::vector<std::int64_t> images_first;

  bool operator==(const TransferPreferences&) const = default;
};

/// A path is thin below this rate: only header, rig, end, coarse clouds, thumbnails and what
/// images_first names travel then. At 16 kB/s the ranges of a room (0.33 MB) take 20 s, twice as
/// long as their sweep.
inline constexpr double kThinBytesPerS = 16'000.0;
/// Fine clouds (0.03 MB a room) pay below this rate: above it the ranges themselves take 2 s.
inline constexpr double kFineCloudBelowBytesPerS = 160'000.0;

/// The item of which a chunk goes next; nullopt = nothing is left of what there is now and may
/// travel. `done` is what the station has, and what was sent to it. Asked again for each chunk,
/// since scan, preferences and rate change: header, rig, end, coarse clouds and thumbnails in turn,
/// images on request, track, device health, previews, fine clouds, ranges, JPEGs, intensities,
/// images. Blocks of lines go in bit-reversed order, so that what has arrived covers the whole
/// scope; those with a line of `lines_first` before others. What a better item has made superfluous
/// is left out (a preview once the image is done). O(items of the kinds that are done).
std::optional<ItemId> NextItem(const ScanToSend& source, const ItemCounts& counts,
                               const ChunkSet& done, const TransferPreferences& preferences);

/// Whether the item is one that NextItem may still return.
bool MayTravel(const ItemId& id, const ItemCounts& counts, const ChunkSet& done,
               const TransferPreferences& preferences);

}  // namespace foresight
