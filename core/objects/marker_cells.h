#pragma once

#include <vector>

#include "core/objects/calibration_board.h"

namespace foresight {

/// Whether a marker's cell is white: bits_a_side + 2 cells a side with the black border, row by
/// row.
std::vector<bool> MarkerCells(CalibrationBoard::Dictionary dictionary, int marker,
                              int* cells_a_side);

}  // namespace foresight
