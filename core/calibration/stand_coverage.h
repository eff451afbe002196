#pragma once

#include <array>
#include <string>

#include "core/calibration/motor_graph.h"

namespace foresight {

/// Which places of the stand a session has, and how its hinge was turned.
struct StandCoverage {
  /// As the head sees the hinge; leaning by its upper end.
  enum Hinge { kUpright, kLeaningLeft, kLevel, kLeaningRight };

  int poses = 0;                   ///< with an image of the stand
  std::array<int, 4> hinges = {};  ///< poses by the hinge's turn; none for a stand of one board
  int left = 0, right = 0;         ///< poses clearly on one side of straight ahead
  int sweeps = 0;
  bool two_boards = true;
  MotorGraph graph;
};

/// `rig` may be rough, the CAD's: places are told by tens of degrees.
StandCoverage MeasureStand(const CalibrationSession& session, const SensorRig& rig);

/// Which place of the stand would help most, after "next: ": "the stand higher, so that the stops
/// 70, 80 deg see it, hinge level". Empty where no further one is needed.
std::string NextPlace(const StandCoverage& coverage);

}  // namespace foresight
