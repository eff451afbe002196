#pragma once

#include <filesystem>
#include <functional>

#include "core/base/run_context.h"
#include "core/calibration/calibration_session.h"

namespace foresight {

/// Finds boards in an image. Fails where the file is no image; a board that is not in it is missing
/// in the answer.
struct BoardFinder {
  std::function<Result<MountView>(const BoardMount&, const std::filesystem::path& image)> mount;
  std::function<Result<std::optional<BoardView>>(const CalibrationBoard&,
                                                 const std::filesystem::path& image)>
      board;
};

/// Reads a session's folder, docs/formats.md. Images are handed to `finder`; without one, a session
/// that has images instead of corners is refused. Everything is checked, and an error names the
/// file and the place in it. Files outside of the folder are refused.
Result<CalibrationSession> ReadCalibrationSession(const std::filesystem::path& folder,
                                                  const BoardFinder* finder,
                                                  const RunContext& context);

/// Writes a session with its corners into `folder`, which is made where it is not there; one that
/// has files is refused. Reading gives the same session, but for the last digits of motor angles.
Status WriteCalibrationSession(const CalibrationSession& session,
                               const std::filesystem::path& folder);

}  // namespace foresight
