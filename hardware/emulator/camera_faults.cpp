#include "hardware/emulator/camera_faults.h"

#include <array>
#include <cmath>
#include <utility>

namespace foresight {

Status CameraFaults::Check() const {
  using Named = std::pair<const char*, double>;
  for (const auto& [name, fraction] :
       std::array<Named, 3>{{{"packet_loss_ratio", packet_loss_ratio},
                             {"ignored_trigger_ratio", ignored_trigger_fraction},
                             {"slow_frame_ratio", slow_frame_fraction}}})
    if (!(fraction >= 0.0 && fraction <= 1.0))
      return Fail(ErrorCode::kInvalidOptions, "{} must be from 0 to 1, is {}", name, fraction);
  for (const auto& [name, value] : std::array<Named, 4>{{{"slow_s", slow_s},
                                                         {"vanish_after_s", vanish_after_s},
                                                         {"vanish_s", vanish_s},
                                                         {"clock_start_s", clock_start_s}}})
    if (!(value >= 0.0 && std::isfinite(value)))
      return Fail(ErrorCode::kInvalidOptions, "{} must not be negative, is {}", name, value);
  if (!(std::abs(clock_ppm) <= 1000.0))
    return Fail(ErrorCode::kInvalidOptions, "clock_ppm must be within 1000, is {}", clock_ppm);
  if (first_block == 0) return Fail(ErrorCode::kInvalidOptions, "first_block must not be 0");
  return {};
}

}  // namespace foresight
