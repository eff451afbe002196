#include "hardware/api/stop_capture.h"

#include "core/geometry/angles.h"
#include "core/sensor/exposure.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

Status StopPlan::Check() const {
  if (angles_rad.empty() || angles_rad.size() > kMostStops)
    return Fail(ErrorCode::kInvalidOptions, "angles_rad: {} stops, 1 to {} are possible",
                angles_rad.size(), kMostStops);
  for (const double angle_rad : angles_rad)
    if (!(angle_rad >= ScanPlan::kMinAngle_rad && angle_rad <= ScanPlan::kMaxAngle_rad))
      return Fail(ErrorCode::kInvalidOptions,
                  "angles_rad: a stop at {:.2f} deg is not within -90 to 90",
                  DegreesFromRadians(angle_rad));
  if (lines < 0 || lines > kMostLines)
    return Fail(ErrorCode::kInvalidOptions, "lines: {} is not within 0 to {}", lines, kMostLines);
  if (lines == 0 && !image)
    return Fail(ErrorCode::kInvalidOptions, "lines: neither lines nor an image are asked for");
  return CheckExposure(exposure_s, gain_db);
}

}  // namespace foresight
