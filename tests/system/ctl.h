#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/run_program.h"
#include "tests/support/small_camera.h"
#include "tests/support/temporary_folder.h"

namespace foresight {

// Scenes that are shipped.
inline const std::string kValveScene = FORESIGHT_SOURCE_DIR "/resources/scenes/valve.yaml";
inline const std::string kRoomScene = FORESIGHT_SOURCE_DIR "/resources/scenes/room.yaml";

/// A rig file of half the default camera's width and height, in a folder.
inline std::string HalfCameraFile(const TemporaryFolder& folder) {
  const std::string file = folder / "half_rig.yaml";
  EXPECT_TRUE(SaveSensorRig(HalfCameraRig(), file));
  return file;
}

/// Around the valve of kValveScene, in the image of that camera.
inline const std::string kValveRegion = "267,206,360,301";

/// Runs foresightctl to its end.
inline ProgramResult Ctl(const std::vector<std::string>& arguments) {
  return RunProgram(FORESIGHTCTL, arguments);
}

}  // namespace foresight
