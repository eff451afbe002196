#pragma once

#include "core/calibration/calibrate_motor.h"

namespace foresight {

/// Corners of the stand of all images of a session; a visit is numbered by pose, then stop.
std::vector<CornerSet> MountCorners(const CalibrationSession& session,
                                    const std::vector<double>& stops_rad);
int VisitCount(const CalibrationSession& session);

/// A start for the motor's least squares, from the images alone: boards are located one by one;
/// turns between stops give axis and angles; the stand's poses are means over their stops. The
/// graph of the session must be complete.
Result<ChainState> InitialMotor(const CalibrationSession& session, const CameraModel& camera,
                                const MotorCalibrationOptions& options,
                                std::vector<std::string>* notes);

}  // namespace foresight
