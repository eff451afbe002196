#pragma once

#include "core/mission/mission_file.h"

namespace foresight {

/// Puts a whole scan into the mission, where it may be already, or a part of it: a scan that was
/// cut short by a link or a crash becomes complete. Returns its id. Lines, samples and images that
/// are there must be the scan's own first ones. Fails with kInvalidInput where the mission has
/// other lines under this uuid, and as the file's calls do.
Result<std::int64_t> CompleteScan(MissionFile& mission, const Scan& whole);

}  // namespace foresight
