#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/sensor/camera_frame.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/motor_track.h"
#include "core/sensor/scan.h"

namespace foresight {

/// What the head captures while it stands, at one angle after the other: what a calibration needs.
struct StopPlan {
  std::vector<double> angles_rad;  ///< of the motor, in the order of the captures
  int lines = 40;                  ///< of the lidar at each stop, a second's worth; 0 = none
  bool image = true;               ///< one at each stop
  double exposure_s = 0.004;
  double gain_db = 0.0;

  static constexpr int kMostStops = 1000;
  static constexpr int kMostLines = 4000;

  /// Names the member at fault. Angles are within ScanPlan's limits.
  Status Check() const;
};

/// What was captured at one stop. Stamps are on the head's clock.
struct StopCapture {
  double target_rad = 0.0;           ///< the plan's
  MotorSample position;              ///< mean of the encoder while the head stood
  std::optional<CameraFrame> image;  ///< nullopt where none was asked for, or none came
  std::vector<LidarLine> lines;      ///< measured while the head stood, in order
};

/// How the captures arrive, one by one: what has come is kept whatever happens later. Called from a
/// thread of the head, never concurrently; return quickly.
class StopSink {
 public:
  virtual ~StopSink() = default;
  virtual void OnStop(const StopCapture& capture) = 0;
  /// Once, after the last capture. A complete end with a reason: which images did not come.
  virtual void OnStopsEnded(ScanState state, const std::string& reason) = 0;
};

}  // namespace foresight
