#pragma once

#include <cstdint>

#include "core/base/image.h"

namespace foresight {

/// One image of the head's camera, with the motor's angle while it was taken.
struct CameraFrame {
  std::int64_t seq = 0;
  double time_s = 0.0;  ///< middle of the exposure, on the scan's clock
  double exposure_s = 0.0;
  double gain_db = 0.0;
  double motor_angle_rad = 0.0;   ///< reported at the middle of the exposure
  double target_angle_rad = 0.0;  ///< where the plan asked for it
  ColorImage image;               ///< a grey camera has r = g = b

  bool operator==(const CameraFrame&) const = default;
};

}  // namespace foresight
