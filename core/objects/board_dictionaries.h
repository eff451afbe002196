#pragma once

#include <vector>

#include "core/objects/calibration_board.h"

namespace foresight {

/// All that a ChArUco board can have, in the order of a list to choose from.
std::vector<CalibrationBoard::Dictionary> BoardDictionaries();

}  // namespace foresight
