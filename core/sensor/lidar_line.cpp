#include "core/sensor/lidar_line.h"

#include <cmath>
#include <limits>

namespace foresight {

Status LidarModel::Check() const {
  if (beams < 1 || beams > 100000)
    return Fail(ErrorCode::kInvalidOptions, "lidar: beams {} is not between 1 and 100000", beams);
  if (!std::isfinite(first_angle_rad) || !(angle_step_rad > 0.0) ||
      !(beams * angle_step_rad < 6.2832 + angle_step_rad))
    return Fail(ErrorCode::kInvalidOptions, "lidar: {} beams of {} rad are more than a turn", beams,
                angle_step_rad);
  if (!(period_s > 0.0 && period_s < 10.0))
    return Fail(ErrorCode::kInvalidOptions, "lidar: period_s {} is not in (0, 10)", period_s);
  if (!(min_range_m >= 0.0 && max_range_m > min_range_m && max_range_m <= 65.0))
    return Fail(ErrorCode::kInvalidOptions, "lidar: ranges {} to {} m are out of order",
                min_range_m, max_range_m);
  if (!std::isfinite(range_offset_m) || !(std::abs(range_offset_m) < 1.0))
    return Fail(ErrorCode::kInvalidOptions, "lidar: range_offset_m {} is not below 1 m",
                range_offset_m);
  if (!std::isfinite(stamp_offset_s) || !(std::abs(stamp_offset_s) < 1.0))
    return Fail(ErrorCode::kInvalidOptions, "lidar: stamp_offset_s {} is not below 1 s",
                stamp_offset_s);
  return {};
}

Eigen::Vector3d LidarModel::BeamDirection(int beam) const {
  const double angle = BeamAngle(beam);
  return {std::cos(angle), std::sin(angle), 0.0};
}

double LidarLine::RawRange(int beam) const {
  const std::uint16_t value = range_mm[static_cast<std::size_t>(beam)];
  if (value < kFirstValidRange_mm) return std::numeric_limits<double>::quiet_NaN();
  return 1e-3 * value;
}

}  // namespace foresight
