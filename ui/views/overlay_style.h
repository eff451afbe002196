#pragma once

#include "core/base/image.h"

namespace foresight {

/// The colour of a region of interest.
constexpr Rgb8 kRoiColor = {255, 255, 255};

}  // namespace foresight
