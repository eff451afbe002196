#pragma once

#include "core/base/image.h"
#include "core/objects/calibration_board.h"

namespace foresight {

/// What a search for a ChArUco board found.
struct CharucoSearch {
  BoardView view;         ///< inner corners with at least one marker beside them
  int markers = 0;        ///< of the board's
  bool mirrored = false;  ///< no marker was found, but some are in the image seen in a mirror
};

/// The corners of a ChArUco board, also of one that is seen in part: the markers name them. A
/// corner is taken where the markers beside it agree about its place and the image has a corner
/// there.
CharucoSearch FindCharuco(const GrayImage& image, const CalibrationBoard& board);

}  // namespace foresight
