#pragma once

#include <string>

#include "core/calibration/calibration_board.h"
#include "core/geometry/rigid.h"
#include "core/sensor/camera_model.h"

namespace foresight {

/// Where a board is in front of a camera.
struct LocatedBoard {
  Rigid<frame::Camera, frame::Pattern> camera_from_board;
  double rms_px = 0.0;  ///< of the distances between corners and their images
};

/// The pose of a board in one image, from at least 6 corners that do not lie on a line. Needs no
/// start: a homography between the board and rays in a virtual camera turned towards it, then least
/// squares in the image; the mirror solution of a far board is tried too. Fails with kTooFewPoints,
/// or with kInvalidInput where the corners are those of a board seen from behind: a mirrored image,
/// or a mirrored print.
Result<LocatedBoard> LocateBoard(const CameraModel& camera, const CalibrationBoard& board,
                                 const BoardView& view, const std::string& source);

}  // namespace foresight
