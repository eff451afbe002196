#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace foresight {

/// How well a camera and its connection do. Counters run since the driver was made.
struct CameraHealth {
  bool connected = false;
  bool suspect = false;              ///< an image is overdue, and the camera has not answered since
  std::int64_t frames = 0;           ///< handed on
  std::int64_t lost = 0;             ///< triggers whose image did not come
  std::int64_t incomplete = 0;       ///< images with packets missing, dropped
  std::int64_t underruns = 0;        ///< images that found no free buffer
  std::int64_t resent_packets = 0;   ///< lost on the way and sent again
  std::int64_t missing_packets = 0;  ///< lost for good
  int reconnects = 0;
  double temperature_c =
      std::numeric_limits<double>::quiet_NaN();  ///< of the device; NaN = it has no sensor
  double clock_offset_s = 0.0;                   ///< head's clock minus the device's
  double clock_uncertainty_s = 0.0;              ///< either way, when the clock was last read
  std::string last_error;                        ///< empty when there was none
};

}  // namespace foresight
