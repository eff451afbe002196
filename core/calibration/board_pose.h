#pragma once

#include <optional>

#include "core/geometry/rigid.h"
#include "core/objects/calibration_board.h"
#include "core/sensor/camera_model.h"

namespace foresight {

using CameraFromPattern = Rigid<frame::Camera, frame::Pattern>;

/// Where a board is, from where its corners appear.
struct BoardPose {
  CameraFromPattern camera_from_pattern;
  double rms_px = 0.0;  ///< root mean square of the corners' distances in the image
};

/// The pose without a guess: linear on the viewing rays, so it holds beyond 90 deg from the axis
/// too, then least squares in the image from both poses that a plane seen from afar can have.
/// nullopt for fewer than 4 corners with a ray and for corners on one line.
std::optional<BoardPose> FindBoardPose(const CalibrationBoard& board, const BoardView& view,
                                       const CameraModel& camera, const BoardWarp& warp = {});

/// Least squares in the image from a pose nearby. A corner that the lens does not show counts as
/// 200 px away. nullopt where fewer than 4 corners are shown.
std::optional<BoardPose> RefineBoardPose(const CalibrationBoard& board, const BoardView& view,
                                         const CameraModel& camera, const CameraFromPattern& start,
                                         const BoardWarp& warp = {}, int iterations = 20);

}  // namespace foresight
