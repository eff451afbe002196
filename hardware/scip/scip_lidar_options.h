#pragma once

#include <string>

#include "core/base/result.h"
#include "hardware/net/tcp_address.h"

namespace foresight {

/// How a ScipLidar talks to its device. Defaults are the UTM-30LX-EW's.
struct ScipLidarOptions {
  enum class Data {
    kRange,           ///< MD: 1.1 Mbit/s
    kRangeIntensity,  ///< ME: 2.2 Mbit/s
    kNearestEcho,     ///< NE: the first echo of each step
    kStrongestEcho,   ///< NE
    kFarthestEcho,    ///< NE: sees through grids and spray
  };

  TcpAddress address{"192.168.0.10", 10940};
  Data data = Data::kRangeIntensity;
  std::string model = "UTM-30LX";  ///< the device's MODL begins with it; empty = any
  int last_step = 1080;            ///< the device's AMAX; a line has last_step + 1 beams
  /// Added to every stamp. The reference point of the stamp within a turn is disputed by 3.13 ms;
  /// calibrate it by scanning an edge upwards and downwards.
  double stamp_offset_s = 0.0;

  double connect_timeout_s = 5.0;  ///< of Connect and Start, with all attempts
  double boot_timeout_s = 15.0;    ///< a device that boots refuses its time mode for seconds
  double reply_timeout_s = 1.0;
  double drain_s = 0.2;     ///< after stopping what an earlier client may have started
  int clock_readings = 40;  ///< about 100 ms on the device
  double resync_s = 0.5;    ///< Start reads the clock again when the last reading is older
  double stall_s = 0.25;    ///< 10 lines of silence: the stream is asked for again
  int stalls_before_reconnect = 3;
  double first_backoff_s = 0.1;  ///< between attempts to connect; doubles
  double last_backoff_s = 2.0;
  double lost_s = 3.0;  ///< silence after which WaitForLine fails; attempts go on

  /// Fails with kInvalidOptions, naming the member.
  Status Check() const;
};

}  // namespace foresight
