#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/image.h"
#include "core/calibration/checkerboard_finder.h"
#include "core/objects/calibration_board.h"

namespace foresight {

/// How well an image shows a board.
struct ImageRating {
  double coverage = 0.0;    ///< of the image, by the hull of the corners; 0 to 1
  double spacing_px = 0.0;  ///< median distance of neighbouring corners
  /// Median width of the edges between squares, from 10 to 90 % of the step; NaN where none could
  /// be measured. 2 is sharp.
  double edge_width_px = std::numeric_limits<double>::quiet_NaN();
  double dark_level = 0.0;   ///< mean grey of the black squares
  double light_level = 0.0;  ///< mean grey of the white squares
  double saturated = 0.0;    ///< fraction of the white squares at 250 and more
  /// How far edges have moved into the black squares, px; light that spills over moves them.
  double spill_px = 0.0;
};

struct BoardDetection {
  BoardView view;         ///< empty where the image is rejected
  std::string rejection;  ///< why, in words; empty where the view can be used
  ImageRating rating;     ///< as far as it could be measured
};

/// Finds a board and rates the image. A checkerboard must be seen whole but for a tenth of its
/// corners, which are left out; a ChArUco board may be seen in part (6 corners, not in one row).
/// Corner 0 of a checkerboard that can be told from its opposite
/// (CalibrationBoard::LooksSameUpsideDown) is the one beside the black square; of the others,
/// either. @pre board.Check()
BoardDetection DetectBoard(const GrayImage& image, const CalibrationBoard& board,
                           SearchEffort effort = SearchEffort::kThorough);
/// The same of an image whose checkerboards were looked for; a rejection does not say what is wrong
/// with the whole image.
BoardDetection DetectBoard(const GrayImage& image, const std::vector<CornerGrid>& grids,
                           const CalibrationBoard& board, SearchEffort effort);

}  // namespace foresight
