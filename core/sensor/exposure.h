#pragma once

#include "core/base/result.h"

namespace foresight {

/// Whether a camera may be asked for this. Fails with kInvalidOptions, naming the value.
Status CheckExposure(double exposure_s, double gain_db);

}  // namespace foresight
