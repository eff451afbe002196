#pragma once

#include <optional>

#include "core/registration/line_registrar.h"
#include "core/registration/register_scan.h"

namespace foresight {

/// The registration of a scan that grows: each update places what is new, so that its cost is that
/// of the new lines and not of the scan. While the scan runs, a line waits until the motor's track
/// says where its beams stood, some 20 ms: so what was handed out never changes, and all results
/// share their points. The result equals RegisterScan's of the same lines in every bit; of a scan
/// that has ended, that is all of them. One thread; results are snapshots that never change.
class GrowingRegistration {
 public:
  /// Takes the scan as it is now: one with the uuid of the last update has grown at its ends, any
  /// other one begins anew. Fails as RegisterScan does, and the next update begins anew then.
  Result<RegisteredScan> Update(const Scan& scan, const RunContext& context);

  /// Lines that the last update placed.
  int lines_placed() const { return lines_placed_; }

 private:
  Result<RegisteredScan> Grow(const Scan& scan, const RunContext& context);
  /// Lines behind the final ones whose angles no later sample of the track changes.
  int NewFinalLines(const Scan& scan) const;

  std::string uuid_;
  std::optional<LineRegistrar> registrar_;
  RegisteredScan scan_;
  int final_lines_ = 0;             ///< that no later sample of the track changes
  std::int64_t final_returns_ = 0;  ///< in them
  int lines_placed_ = 0;
};

}  // namespace foresight
