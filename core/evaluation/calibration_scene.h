#pragma once

#include <string>

#include "core/evaluation/simulate_calibration.h"

namespace foresight {

/// A scene file (docs/simulation.md): a room with the boards of a simulated session, a board for
/// the camera alone at the session's intrinsic views (for the motor at 0) and the stand at its
/// poses. A head that is `made.truth` can record the session there. Checkerboards that can be told
/// apart are needed: CalibrationSimulation::distinct_boards.
std::string CalibrationSceneYaml(const SimulatedCalibration& made);

/// Makes ChArUco boards of a stand's checkerboards. Without markers the detector takes the two for
/// one board across the hinge in some images.
void MarkBoards(BoardMount* mount);

}  // namespace foresight
