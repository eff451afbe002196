#include "hardware/scip/scip_stamp_watch.h"

#include <fmt/format.h>

namespace foresight {

void ScipStampWatch::Reset(std::int64_t device_ms) {
  last_ms_ = device_ms;
  of_line_ = false;
  late_since_s_.reset();
}

std::optional<std::string> ScipStampWatch::Check(std::uint32_t stamp_ms, double arrival_s,
                                                 double offset_s) {
  if (!last_ms_) last_ms_ = stamp_ms;
  std::int64_t step_ms = (stamp_ms - *last_ms_) & 0xFFFFFF;
  if (step_ms >= 0x800000) step_ms -= 0x1000000;
  if (of_line_ && step_ms == 0)
    return fmt::format("stand still at {:.3f} s", 1e-3 * static_cast<double>(stamp_ms));
  // A line may have begun before the clock was read for the last time.
  if (of_line_ && step_ms < 0)
    return fmt::format("ran backwards by {:.3f} s", -1e-3 * static_cast<double>(step_ms));
  const std::int64_t unwrapped_ms = *last_ms_ + step_ms;
  const double late_s = arrival_s - (1e-3 * static_cast<double>(unwrapped_ms) + offset_s);
  if (late_s < -kAhead_s) return fmt::format("jumped ahead by {:.3f} s", -late_s);
  if (late_s > kTooLate_s) return fmt::format("lie {:.3f} s behind", late_s);
  if (late_s < kLate_s) {
    late_since_s_.reset();
  } else if (!late_since_s_) {
    late_since_s_ = arrival_s;
  } else if (arrival_s - *late_since_s_ > kLateFor_s) {
    return fmt::format("lie {:.3f} s behind", late_s);
  }
  last_ms_ = unwrapped_ms;
  of_line_ = true;
  return std::nullopt;
}

}  // namespace foresight
