#pragma once

#include "core/base/image.h"

namespace foresight {

/// A button that is released this near to where it was pressed has clicked, not dragged.
constexpr int kClickSlack_px = 4;

/// The colour of a region of interest.
constexpr Rgb8 kRoiColor = {255, 255, 255};

}  // namespace foresight
