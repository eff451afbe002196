#pragma once

#include <cstdint>

namespace foresight {

/// How the connection to a motor's drive is doing. The rate is that of the last second, the round
/// trips those of the last 240 polls.
struct MotorHealth {
  bool connected = false;
  double poll_rate_hz = 0.0;
  double round_trip_median_s = 0.0;
  double round_trip_max_s = 0.0;
  int reconnects = 0;      ///< since the first connection
  std::int64_t polls = 0;  ///< that were answered, since the driver was made
  std::int64_t slow_polls =
      0;  ///< samples left out of the track: nobody knows when they were taken
  std::uint16_t last_error = 0;  ///< the drive's last error, object 603Fh; 0 = none so far
};

}  // namespace foresight
