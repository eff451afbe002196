#include "hardware/emulator/lidar_faults.h"

#include <array>
#include <cmath>
#include <utility>

namespace foresight {

Status LidarFaults::Check() const {
  const std::array<std::pair<const char*, double>, 3> fractions{
      {{"corrupt_ratio", corrupt_fraction},
       {"reset_ratio", reset_fraction},
       {"stall_ratio", stall_fraction}}};
  for (const auto& [name, fraction] : fractions)
    if (!(fraction >= 0.0 && fraction <= 1.0))
      return Fail(ErrorCode::kInvalidOptions, "{} must be from 0 to 1, is {}", name, fraction);
  const std::array<std::pair<const char*, double>, 6> counts{
      {{"stall_s", stall_s},
       {"boot_delay_s", boot_delay_s},
       {"fragment_bytes", fragment_bytes},
       {"clock_jump_after_s", clock_jump_after_s},
       {"clock_stop_after_s", clock_stop_after_s},
       {"missing_beams", missing_beams}}};
  for (const auto& [name, value] : counts)
    if (!(value >= 0.0))
      return Fail(ErrorCode::kInvalidOptions, "{} must not be negative, is {}", name, value);
  if (!(std::abs(clock_jump_s) <= 4000.0))
    return Fail(ErrorCode::kInvalidOptions, "clock_jump_s must be within 4000, is {}",
                clock_jump_s);
  if (clock_start_ms > 0xFFFFFF)
    return Fail(ErrorCode::kInvalidOptions, "clock_start_ms must fit 24 bits, is {}",
                clock_start_ms);
  return {};
}

}  // namespace foresight
