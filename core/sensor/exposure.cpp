#include "core/sensor/exposure.h"

namespace foresight {

Status CheckExposure(double exposure_s, double gain_db) {
  if (!(exposure_s > 0.0 && exposure_s <= 1.0))
    return Fail(ErrorCode::kInvalidOptions, "exposure_s: {} is not within 0 to 1 s", exposure_s);
  if (!(gain_db >= 0.0 && gain_db <= 48.0))
    return Fail(ErrorCode::kInvalidOptions, "gain_db: {} is not within 0 to 48", gain_db);
  return {};
}

}  // namespace foresight
