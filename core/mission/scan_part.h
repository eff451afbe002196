#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/sensor/scan.h"

namespace foresight {

/// Which lines of a scan a result was made from, where that was before all of them were there.
struct ScanPart {
  std::vector<std::pair<std::int64_t, std::int64_t>>
      seqs;          ///< first and last LidarLine::seq of each run of lines, ascending
  int lines = 0;     ///< that were there
  int of_lines = 0;  ///< that were expected; 0 = not known

  bool operator==(const ScanPart&) const = default;
};

/// All lines that the scan has now.
ScanPart PartOf(const Scan& scan, int of_lines);

/// The scan with just these lines. Fails with kInvalidInput where it does not have them.
Result<Scan> TakePart(const Scan& scan, const ScanPart& part);

}  // namespace foresight
