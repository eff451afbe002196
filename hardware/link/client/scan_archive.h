#pragma once

#include "core/sensor/scan.h"

namespace foresight {

/// Where whole scans are kept for good. Called from one thread of a head, never concurrently.
class ScanArchive {
 public:
  virtual ~ScanArchive() = default;
  /// The scan is on the disk when it returns; one that is there already, whole or in part, is
  /// completed. Until then the spool of the link holds it, and it is tried again.
  virtual Status Keep(const Scan& whole) = 0;
};

}  // namespace foresight
