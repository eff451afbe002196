#pragma once

#include <string>

#include "core/geometry/rigid.h"
#include "core/objects/calibration_board.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// Where a board is in front of a camera.
struct LocatedBoard {
  Rigid<frame::Camera, frame::Pattern> camera_from_board;
  double rms_px = 0.0;  ///< of the distances between corners and their images
};

/// The pose of a board in one image, from at least 6 corners that do not lie on a line; needs no
/// start. Fails with kTooFewPoints, or with kInvalidInput where the corners are those of a board
/// seen from behind: a mirrored image, or a mirrored print.
Result<LocatedBoard> LocateBoard(const CameraModel& camera, const CalibrationBoard& board,
                                 const BoardView& view, const std::string& source);

}  // namespace foresight
