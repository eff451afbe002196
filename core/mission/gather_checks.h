#pragma once

#include <optional>
#include <span>

#include "core/mission/kept_check.h"

namespace foresight {

/// What scans that were taken with one rig say of it together.
struct GatheredCheck {
  int scans = 0;    ///< that measured anything
  ScanCheck check;  ///< without depth and objects, which are one scan's own
};

/// Of the newest check of each scan that was checked with `rig`; nothing where fewer than two of
/// these measured anything.
std::optional<GatheredCheck> GatherChecks(std::span<const KeptCheck> checks, const SensorRig& rig);

}  // namespace foresight
