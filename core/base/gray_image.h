#pragma once

#include "core/base/image.h"

namespace foresight {

/// Whether all pixels have r = g = b, as those of a grey camera.
bool IsGray(const ColorImage& image);
/// The red values: all there is of a grey image.
GrayImage RedOf(const ColorImage& image);
/// The colours of a grey image.
ColorImage ColorOf(const GrayImage& image);

}  // namespace foresight
