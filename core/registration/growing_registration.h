#pragma once

#include <optional>

#include "core/registration/line_registrar.h"
#include "core/registration/register_scan.h"

namespace foresight {

/// The registration of a scan that grows: each update places what is new, so that its cost is that
/// of the new lines and not of the scan. The result equals RegisterScan's of the same scan in every
/// bit. One thread; results are snapshots that never change.
class GrowingRegistration {
 public:
  /// Takes the scan as it is now: one with the uuid of the last update has grown at its ends, any
  /// other one begins anew. A line near the end of the track is placed again when more of the track
  /// is known. Fails as RegisterScan does, and the next update begins anew then.
  Result<RegisteredScan> Update(const Scan& scan, const RunContext& context);

  /// Lines that the last update placed, new ones and those placed again.
  int lines_placed() const { return lines_placed_; }

 private:
  Result<RegisteredScan> Grow(const Scan& scan, const RunContext& context);

  std::string uuid_;
  std::optional<LineRegistrar> registrar_;
  RegisteredScan scan_;
  int final_lines_ = 0;             ///< that no later sample of the track changes
  std::int64_t final_returns_ = 0;  ///< in them
  int lines_placed_ = 0;
};

}  // namespace foresight
