#include "hardware/scip/scip_lidar_options.h"

#include <cmath>

namespace foresight {
namespace {

Status NotNegative(const char* name, double value) {
  if (value >= 0.0 && std::isfinite(value)) return {};
  return Fail(ErrorCode::kInvalidOptions, "{} must not be negative, is {}", name, value);
}

Status AtLeastOne(const char* name, int value) {
  if (value >= 1) return {};
  return Fail(ErrorCode::kInvalidOptions, "{} must be at least 1, is {}", name, value);
}

}  // namespace

Status ScipLidarOptions::Check() const {
  if (address.host.empty() || address.port == 0)
    return Fail(ErrorCode::kInvalidOptions, "address must be a host and a port, is {}",
                address.ToText());
  if (last_step < 0 || last_step > 9999)
    return Fail(ErrorCode::kInvalidOptions, "last_step must be from 0 to 9999, is {}", last_step);
  if (!std::isfinite(stamp_offset_s))
    return Fail(ErrorCode::kInvalidOptions, "stamp_offset_s must be finite, is {}", stamp_offset_s);
  FORESIGHT_CHECK(NotNegative("connect_timeout_s", connect_timeout_s));
  FORESIGHT_CHECK(NotNegative("boot_timeout_s", boot_timeout_s));
  FORESIGHT_CHECK(NotNegative("reply_timeout_s", reply_timeout_s));
  FORESIGHT_CHECK(NotNegative("drain_s", drain_s));
  FORESIGHT_CHECK(AtLeastOne("clock_readings", clock_readings));
  FORESIGHT_CHECK(NotNegative("resync_s", resync_s));
  FORESIGHT_CHECK(NotNegative("stall_s", stall_s));
  FORESIGHT_CHECK(AtLeastOne("stalls_before_reconnect", stalls_before_reconnect));
  FORESIGHT_CHECK(NotNegative("first_backoff_s", first_backoff_s));
  FORESIGHT_CHECK(NotNegative("last_backoff_s", last_backoff_s));
  return NotNegative("lost_s", lost_s);
}

}  // namespace foresight
