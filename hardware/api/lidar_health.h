#pragma once

#include <cstdint>
#include <string>

namespace foresight {

/// How well a lidar and its connection do. Counters run since the driver was made.
struct LidarHealth {
  bool connected = false;
  bool streaming = false;       ///< scans are wanted and come
  double line_rate_hz = 0.0;    ///< over the last second
  std::int64_t lines = 0;       ///< handed on
  std::int64_t lost_lines = 0;  ///< missing between lines of one stream, for whatever reason
  std::int64_t damaged = 0;     ///< replies with wrong sums
  std::int64_t stale = 0;       ///< scans of an earlier stream, discarded
  std::int64_t stalls = 0;      ///< silences after which the stream was asked for again
  std::int64_t reconnects = 0;
  std::int64_t reboots = 0;
  double clock_offset_s = 0.0;     ///< head's clock minus the device's (24 bits of ms, unwrapped)
  double clock_drift_ppm = 0.0;    ///< of the device's clock against the head's; positive = slow
  double sync_round_trip_s = 0.0;  ///< of the best reading of the device's clock
  std::string last_error;          ///< empty when there was none
  /// What is wrong with the lines that come now, e.g. "37 of 40 lines had a bad check sum in the
  /// last 1.5 s"; empty when nothing is.
  std::string trouble;
};

}  // namespace foresight
