#include "hardware/motor/modbus_motor_options.h"

#include <cmath>

namespace foresight {

Status ModbusMotorOptions::Check() const {
  const auto positive = [](double value, const char* member) -> Status {
    if (value > 0.0 && std::isfinite(value)) return {};
    return Fail(ErrorCode::kInvalidOptions, "motor: {} {} is not positive", member, value);
  };
  if (host.empty()) return Fail(ErrorCode::kInvalidOptions, "motor: host is empty");
  if (!(min_angle_rad < max_angle_rad))
    return Fail(ErrorCode::kInvalidOptions, "motor: min_angle_rad {} is not below max_angle_rad {}",
                min_angle_rad, max_angle_rad);
  FORESIGHT_CHECK(positive(counts_per_turn, "counts_per_turn"));
  FORESIGHT_CHECK(positive(max_speed_rad_s, "max_speed_rad_s"));
  FORESIGHT_CHECK(positive(acceleration_rad_s2, "acceleration_rad_s2"));
  FORESIGHT_CHECK(positive(homing_search_rad_s, "homing_search_rad_s"));
  FORESIGHT_CHECK(positive(homing_edge_rad_s, "homing_edge_rad_s"));
  FORESIGHT_CHECK(positive(homing_timeout_s, "homing_timeout_s"));
  FORESIGHT_CHECK(positive(poll_rate_hz, "poll_rate_hz"));
  FORESIGHT_CHECK(positive(static_cast<double>(response_timeout.count()), "response_timeout"));
  FORESIGHT_CHECK(positive(slow_round_trip_s, "slow_round_trip_s"));
  return positive(remembered_s, "remembered_s");
}

}  // namespace foresight
