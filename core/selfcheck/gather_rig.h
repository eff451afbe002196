#pragma once

#include <span>

#include "core/selfcheck/check_rig.h"

namespace foresight {

/// What several scans taken with one rig say of it together: turns and drifts are averaged by their
/// covariances, which grow where the scans differ by more than these say. Scans that saw nothing
/// take no part; where none saw something, the first one's reason is kept.
/// @param checks of scans with this rig
RigCheck GatherRig(std::span<const RigCheck> checks, const SensorRig& rig,
                   const RigCheckLimits& limits);

}  // namespace foresight
