#pragma once

#include "core/calibration/calibration_session.h"
#include "core/selfcheck/check_rig.h"

namespace foresight {

/// From where on boards show a drift.
struct SessionCheckLimits {
  double corner_px = 0.45;   ///< mean error of the corners with the rig's camera
  double turn_rad = 0.0017;  ///< of the axis, a stop and the lidar: 0.1 deg, 5 mm at 3 m
  double shift_m = 0.005;    ///< of the axis and the lidar
  double range_m = 0.010;
  double stamp_s = 0.002;
  double sigmas = 4.0;
  double seen_sigmas = 2.5;
};

/// What a fresh session of boards says of a rig.
struct SessionCheck {
  double mean_error_px = 0.0;
  double range_rms_m = 0.0;  ///< of the lidar's returns along their beams; 0 = the session has none
  std::vector<RigFinding> findings;
  std::vector<std::string> drifted;  ///< sentences; empty = the rig is fine
  std::vector<std::string> notes;    ///< the calibration's

  bool Drifted() const { return !drifted.empty(); }
};

/// Calibrates motor, lidar and stamps afresh with the rig's camera, which stays as it is, and
/// compares: the motor's axis, the plate's angles against that at 0 deg, the lidar's pose and its
/// offsets, each with its deviation; the camera by the error of the corners. Fails as
/// CalibrateChain does.
Result<SessionCheck> CheckSession(CalibrationSession session, const SensorRig& rig,
                                  const SessionCheckLimits& limits, const RunContext& context);

}  // namespace foresight
