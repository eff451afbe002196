#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/calibration_session.h"
#include "core/sensor/camera_model.h"

namespace foresight {

using CameraFromStand = Rigid<frame::Camera, frame::Pattern>;

/// The boards of one image, located.
struct LocatedView {
  std::string source;
  int pose = 0;
  int stop = 0;     ///< of the session's StopAngles
  int capture = 0;  ///< of the pose's stops
  std::optional<CameraFromStand> a, b;
  double rms_a_px = 0.0, rms_b_px = 0.0;  ///< of the corners of each
  CameraFromStand stand;                  ///< of board A; not filled in by LocateStand
};

/// "room/stop_03.png, pose 2, stop 10 deg".
std::string NameOfStop(const PatternPose& pose, const MotorStop& stop);

/// The boards of all images, one by one. A board with too few corners is left out with a note; one
/// that is mirrored is an error.
Result<std::vector<LocatedView>> LocateStand(const CalibrationSession& session,
                                             const CameraModel& camera,
                                             std::vector<std::string>* notes);

/// Board B as the images have it, the mean of those that agree. Fails where most do not have it as
/// drawn, or one does not have it as the others.
Result<BoardFromBoard> LocateBoardB(const CalibrationSession& session,
                                    const std::vector<LocatedView>& views,
                                    std::vector<std::string>* notes);

/// Leaves images out whose boards cannot be what they were taken for, with a note each: corners
/// that do not lie in a plane, or two boards that stand to each other as in no other image (a grid
/// that was found across the hinge, exchanged boards, a stand that moved). Where that is more than
/// one image in five, something else is wrong, and all of them stay.
Result<CalibrationSession> WithoutMisfits(CalibrationSession session, const CameraModel& camera,
                                          std::vector<std::string>* notes);

}  // namespace foresight
