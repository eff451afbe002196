#pragma once

#include "core/geometry/angles.h"
#include "core/sensor/scan_plan.h"

namespace foresight {

/// 20 deg in two seconds, with one image.
inline ScanPlan SmallSweep() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-25.0);
  plan.to_rad = RadiansFromDegrees(-5.0);
  plan.image_angles_rad = {RadiansFromDegrees(-15.0)};
  return plan;
}

}  // namespace foresight
