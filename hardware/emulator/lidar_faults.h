#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace foresight {

/// What is wrong with an emulated lidar, from its beginning. Fractions are of scans; which ones
/// they affect is decided by the seed and the scan's turn, so a run can be repeated.
struct LidarFaults {
  std::uint64_t seed = 1;
  double corrupt_fraction = 0.0;  ///< one bit of the data is flipped, the sums are not
  double reset_fraction = 0.0;    ///< the connection is reset instead
  double stall_fraction = 0.0;    ///< the stream is silent for stall_s from there
  double stall_s = 0.3;
  int fragment_bytes = 0;            ///< everything is sent in pieces of so many bytes; 0 = whole
  double boot_delay_s = 0.0;         ///< after power-on the device refuses to work for so long
  double clock_ppm = 0.0;            ///< the device's clock runs fast by so much
  std::uint32_t clock_start_ms = 0;  ///< the clock's value at power-on; near 2^24 it wraps soon
  double clock_jump_s = 0.0;         ///< its clock jumps by so much, or back,
  double clock_jump_after_s = 0.0;   ///< so long after power-on
  double clock_stop_after_s = 0.0;   ///< after power-on its clock stands still; 0 = never
  int missing_beams = 0;             ///< of each scan, at its end
  bool abnormal = false;             ///< refuses to work, status 0L, until it is rebooted
  bool ignores_first_quit = false;   ///< the first QT of every connection

  /// Fails with kInvalidOptions, naming the member.
  Status Check() const;
};

}  // namespace foresight
