#pragma once

#include <string>

#include "core/mission/mission_file.h"

namespace foresight {

/// The object with this number or uuid, a deleted one too. Fails with kInvalidInput.
Result<DetectionRecord> ChooseObject(const MissionFile& mission, const std::string& wanted);

}  // namespace foresight
