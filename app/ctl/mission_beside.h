#pragma once

#include <memory>
#include <string>

#include "core/mission/mission_file.h"

namespace foresight {

/// The mission with the scans of a review, which keeps what was found in the mission beside it;
/// nullptr where `mission` is no review. Fails with kIo where it is not there.
Result<std::unique_ptr<MissionFile>> MissionBeside(const MissionFile& mission);

}  // namespace foresight
