#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/mission/mission_records.h"

namespace foresight {

struct MergeOptions {
  /// Which scans are taken, with everything found in them; empty = all.
  std::function<bool(const ScanSummary& scan)> keep;
};

struct MergeReport {
  std::int64_t scans = 0;
  std::int64_t already_there = 0;  ///< the same uuid in an earlier source: its first copy stays
  std::int64_t left_out = 0;       ///< by `keep`
  std::int64_t detections = 0;
  std::int64_t depth_maps = 0;
  std::int64_t notes = 0;  ///< and measurements
  std::int64_t events = 0;
};

/// Writes one new mission with the scans of several, in the order of the sources, and their log,
/// in which a line that two sources share stands once. Scans, detections and depth maps keep their
/// uuids, get new ids, and are otherwise copied bit for bit. Reviews (`NAME.review.foresight`) add
/// what they hold to the scans of their mission. `target` is written whole or not at all, and no
/// source is touched. Fails with kIo, with kBadData where a row's checksum is wrong (salvage that
/// source first), with kInvalidInput where two sources hold different scans under one uuid or the
/// target is one of the sources, and with kCancelled.
Result<MergeReport> MergeMissions(std::span<const std::filesystem::path> sources,
                                  const std::filesystem::path& target, const MergeOptions& options,
                                  const RunContext& context);

}  // namespace foresight
