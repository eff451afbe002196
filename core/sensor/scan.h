#pragma once

#include <cstdint>
#include <string>

#include "core/base/shared_list.h"
#include "core/sensor/camera_frame.h"
#include "core/sensor/given_cloud.h"
#include "core/sensor/lidar_line.h"
#include "core/sensor/motor_track.h"
#include "core/sensor/scan_plan.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {

/// How a scan ended.
enum class ScanState { kRunning, kComplete, kAborted, kInterrupted };

/// "running", "complete", "aborted", "interrupted".
const char* ToString(ScanState state);
/// The reverse; fails with kBadData.
Result<ScanState> ScanStateFromString(const std::string& text);

/// Everything one sweep of the head brought home, as it came from the devices. A copy shares lines,
/// images and track with the original, so it costs the same whatever their number; whoever appends
/// to one of them does not disturb the other.
struct Scan {
  std::string uuid;
  std::int64_t start_utc_ns = 0;  ///< wall clock at time 0 of the scan's own clock
  std::string source;             ///< which head, e.g. "simulated: valve, seed 1"
  bool simulated = false;
  ScanPlan plan;
  SensorRig rig;
  SharedList<LidarLine> lines;
  MotorTrack track;
  SharedList<CameraFrame> frames;
  /// Of a scan that was imported, which has no lines and no track; else empty.
  GivenCloud given;
  ScanState state = ScanState::kRunning;
  std::string reason;  ///< why it did not complete
};

/// The frame of the scan whose motor angle is nearest to `angle_rad`; nullptr when there is none.
const CameraFrame* NearestFrame(const Scan& scan, double angle_rad);

/// When the scan began, in wall-clock time: its first line or, without one, its first motor sample;
/// start_utc_ns where it has neither. (start_utc_ns is when the head's clock began.)
std::int64_t BeginUtc_ns(const Scan& scan);

/// A new random identifier (UUID version 4).
std::string NewUuid();

}  // namespace foresight
