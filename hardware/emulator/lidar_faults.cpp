#include "hardware/emulator/lidar_faults.h"

#include <array>
#include <utility>

namespace foresight {

Status LidarFaults::Check() const {
  const std::array<std::pair<const char*, double>, 3> shares{{{"corrupt_share", corrupt_share},
                                                              {"reset_share", reset_share},
                                                              {"stall_share", stall_share}}};
  for (const auto& [name, share] : shares)
    if (!(share >= 0.0 && share <= 1.0))
      return Fail(ErrorCode::kInvalidOptions, "{} must be from 0 to 1, is {}", name, share);
  const std::array<std::pair<const char*, double>, 3> counts{
      {{"stall_s", stall_s}, {"boot_delay_s", boot_delay_s}, {"fragment_bytes", fragment_bytes}}};
  for (const auto& [name, value] : counts)
    if (!(value >= 0.0))
      return Fail(ErrorCode::kInvalidOptions, "{} must not be negative, is {}", name, value);
  if (clock_start_ms > 0xFFFFFF)
    return Fail(ErrorCode::kInvalidOptions, "clock_start_ms must fit 24 bits, is {}",
                clock_start_ms);
  return {};
}

}  // namespace foresight
