#pragma once

#include <cstdint>

#include "core/mission/mission_file.h"

namespace foresight {

/// The id of the scan with this number, of the last one for 0. Fails with kInvalidInput.
Result<std::int64_t> ChooseScan(const MissionFile& mission, std::int64_t wanted);

}  // namespace foresight
