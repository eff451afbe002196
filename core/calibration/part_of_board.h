#pragma once

#include "core/calibration/board_detector.h"

namespace foresight {

/// Whether what was found as `board` may be a part of `other` that the image's border cuts off:
/// `other` is a checkerboard with at least as many corners each way, and the squares around the
/// corners that were found are not all in the image. @pre the view is of the whole board
bool MayBePartOf(const CalibrationBoard& board, const BoardView& view,
                 const CalibrationBoard& other, int width, int height);

}  // namespace foresight
