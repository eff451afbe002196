#pragma once

#include <filesystem>
#include <vector>

#include "core/base/run_context.h"
#include "core/calibration/board_detector.h"
#include "core/calibration/intrinsics.h"

namespace foresight {

/// Images of one board by one camera.
struct BoardImages {
  int width = 0;
  int height = 0;
  std::vector<IntrinsicsImage> images;  ///< those with a view, in the order of the files
  std::vector<ImageRating> ratings;     ///< of those
  std::vector<RejectedImage> rejected;  ///< files without, and why
};

/// Image files, and the image files of folders (not of folders in them), in the order given and by
/// name with numbers by value. Fails with kIo, naming what is not there or a folder without images.
Result<std::vector<std::filesystem::path>> ListImageFiles(const std::vector<std::string>& places);

/// Reads files and detects the board in each, on all threads. A file is rejected with the reason
/// where it cannot be read, has another size than most, equals an earlier one pixel by pixel, shows
/// no board, or is much more blurred than the others. Fails with kCancelled only.
Result<BoardImages> DetectBoards(const std::vector<std::filesystem::path>& files,
                                 const CalibrationBoard& board, const RunContext& context);

}  // namespace foresight
