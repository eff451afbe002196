#pragma once

#include <string>

#include "core/base/result.h"

namespace foresight {

/// Where a GigE Vision camera is and how it is used.
struct GigeCameraOptions {
  enum class Format {
    kMono8,
    kBayerRG8,  ///< becomes colour here; a third of RGB8's packets
    kRGB8,
  };

  std::string address = "192.168.0.20";  ///< IPv4
  Format format = Format::kBayerRG8;
  /// Added to every stamp. 0 is right for a camera that stamps the beginning of the exposure; minus
  /// the exposure's length would be right for one that stamps its end.
  double stamp_offset_s = 0.0;
  /// From the end of the exposure; then the camera is suspect and WaitForFrame fails.
  double frame_timeout_s = 0.5;

  double connect_timeout_s = 8.0;  ///< of Connect; longer than a crashed client keeps control
  double configure_timeout_s = 0.5;
  double frame_retention_s = 0.2;  ///< an image's packets are waited for so long
  int packet_bytes = 0;            ///< 0: what the network lets through, found by test packets
  double packet_delay_s = 0.0;     ///< between packets; for switches with small buffers
  int buffers = 4;
  int clock_readings = 8;
  double resync_s = 2.0;         ///< between readings of the device's clock
  double first_backoff_s = 0.1;  ///< between attempts to connect; doubles
  double last_backoff_s = 2.0;

  /// Fails with kInvalidOptions, naming the member.
  Status Check() const;
};

/// "Mono8", "BayerRG8", "RGB8".
const char* ToString(GigeCameraOptions::Format format);

}  // namespace foresight
