#pragma once

#include <filesystem>
#include <vector>

#include "core/base/run_context.h"
#include "core/calibration/board_detector.h"
#include "core/calibration/intrinsics.h"

namespace foresight {

/// What one image shows of a board, before it is compared with the other images.
struct BoardImage {
  std::string fault;  ///< why the file cannot be read; empty where it can
  int width = 0;
  int height = 0;
  std::string hash;  ///< of the pixels
  BoardDetection detection;
};

/// Reads a file and detects the board. @pre board.Check()
BoardImage ReadBoardImage(const std::filesystem::path& file, const CalibrationBoard& board);
/// The same of an image that was read.
BoardImage InspectBoardImage(const GrayImage& image, const CalibrationBoard& board);

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

/// Tells the images that can be used from those that cannot. An image is rejected with the reason
/// where it cannot be read, has another size than most, equals an earlier one pixel by pixel, shows
/// no board, or is much more blurred than the others. @pre as many names as images
BoardImages SortBoardImages(const std::vector<std::string>& names, std::vector<BoardImage> images);

/// Reads files, detects the board in each on all threads, and sorts them by their paths. Fails with
/// kCancelled only.
Result<BoardImages> DetectBoards(const std::vector<std::filesystem::path>& files,
                                 const CalibrationBoard& board, const RunContext& context);

}  // namespace foresight
