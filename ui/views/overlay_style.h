#pragma once

#include "core/base/image.h"

namespace foresight {

/// The colour of a fitted template in every pane. Magenta: the one hue that the turbo map has not.
constexpr Rgb8 kTemplateColor = {255, 64, 208};
/// The colour of a region of interest.
constexpr Rgb8 kRoiColor = {255, 255, 255};

}  // namespace foresight
