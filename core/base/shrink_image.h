#pragma once

#include "core/base/image.h"

namespace foresight {

/// The image with at most `largest_side` pixels in width and height, each the mean of those that it
/// covers; an image that is small enough is returned as it is. @pre largest_side >= 1
ColorImage ShrinkImage(const ColorImage& image, int largest_side);

}  // namespace foresight
