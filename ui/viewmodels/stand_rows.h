#pragma once

#include <vector>

#include "core/calibration/session_file.h"
#include "core/calibration/session_index.h"
#include "ui/viewmodels/chain_solution.h"
#include "ui/viewmodels/stand_place_row.h"

namespace foresight {

/// A session as its rows show it.
struct StandRowsSource {
  const SessionIndex* index = nullptr;
  const FoundViews* found = nullptr;
  const ChainSolution* solution = nullptr;  ///< nullptr = none yet
  CalibrationStage stage = CalibrationStage::kAll;
  int present_place = -1;                ///< where captures go on; -1 = nowhere
  std::vector<double> planned_rad = {};  ///< its stops
};

/// A row a place, with a lamp for each stop that is captured or planned there.
std::vector<StandPlaceRow> StandPlaceRows(const StandRowsSource& source);
/// A row an image of the single board.
std::vector<BoardImageRow> BoardImageRows(const StandRowsSource& source);

/// What was found in a file; nullptr = it has not been looked at.
const MountView* FoundIn(const std::map<std::string, MountView>& views, const std::string& file);
bool SameStop(double a_rad, double b_rad);

}  // namespace foresight
