#pragma once

#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace foresight {

// Scenes that are shipped.
inline const std::string kValveScene = FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
inline const std::string kRoomScene = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";

/// Runs foresightctl to its end.
inline ProgramResult Ctl(const std::vector<std::string>& arguments) {
  return RunProgram(FORESIGHTCTL, arguments);
}

}  // namespace foresight
