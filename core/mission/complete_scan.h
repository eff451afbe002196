#pragma once

#include "core/base/run_context.h"
#include "core/mission/mission_file.h"

namespace foresight {

/// Puts a whole scan into the mission, where it may be already, or a part of it: a scan that was
/// cut short by a link or a crash becomes complete. Returns its id. Lines, samples and images that
/// are there must be the scan's own first ones. Fails with kInvalidInput where the mission has
/// other lines under this uuid, and as the file's calls do; the scan reads as interrupted then.
Result<std::int64_t> CompleteScan(MissionFile& mission, const Scan& whole,
                                  const RunContext& context = {});

/// Whether the mission's scan `id` has as many lines, samples and images as `whole`, and its end:
/// what is asked where the recording wrote the same scan and may have failed on the way. Decodes no
/// image.
Result<bool> HoldsAllOf(const MissionFile& mission, std::int64_t id, const Scan& whole);

}  // namespace foresight
