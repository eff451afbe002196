#include "hardware/head/capture_options.h"

#include <cmath>

namespace foresight {

Status CaptureOptions::Check() const {
  const auto positive = [](double value, const char* member) -> Status {
    if (value > 0.0 && std::isfinite(value)) return {};
    return Fail(ErrorCode::kInvalidOptions, "capture: {} {} is not positive", member, value);
  };
  FORESIGHT_CHECK(positive(acceleration_rad_s2, "acceleration_rad_s2"));
  FORESIGHT_CHECK(positive(settle_s, "settle_s"));
  FORESIGHT_CHECK(positive(travel_speed_rad_s, "travel_speed_rad_s"));
  FORESIGHT_CHECK(positive(homing_timeout_s, "homing_timeout_s"));
  FORESIGHT_CHECK(positive(lidar_timeout_s, "lidar_timeout_s"));
  if (!(line_floor >= 0.0 && line_floor <= 1.0))
    return Fail(ErrorCode::kInvalidOptions, "capture: line_floor {} is not in [0, 1]", line_floor);
  FORESIGHT_CHECK(positive(camera_timeout_s, "camera_timeout_s"));
  return operator_timeout_s == 0.0 ? Status() : positive(operator_timeout_s, "operator_timeout_s");
}

double CaptureOptions::RunUp(double speed_rad_s) const {
  return speed_rad_s * speed_rad_s / (2.0 * acceleration_rad_s2) + speed_rad_s * settle_s;
}

}  // namespace foresight
