#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace foresight {

/// What is wrong with an emulated camera, from its beginning. Which packets and images the
/// fractions affect is decided by the seed and their numbers, so a run can be repeated.
struct CameraFaults {
  std::uint64_t seed = 1;
  double packet_loss_ratio = 0.0;         ///< of the stream's packets, sent again ones too
  double ignored_trigger_fraction = 0.0;  ///< acknowledged, but no image is taken
  double slow_frame_fraction = 0.0;       ///< an image leaves slow_s late
  double slow_s = 0.3;
  double vanish_after_s = 0.0;    ///< of its life; then it answers nothing
  double vanish_s = 0.0;          ///< for so long; 0 = never
  double clock_ppm = 0.0;         ///< the device's clock runs fast by so much
  double clock_start_s = 0.0;     ///< the device's clock at power-on
  std::uint16_t first_block = 1;  ///< number of the first image; near 65535 it wraps soon

  /// Fails with kInvalidOptions, naming the member.
  Status Check() const;
};

}  // namespace foresight
