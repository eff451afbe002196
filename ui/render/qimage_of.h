#pragma once

#include <QImage>

#include "core/base/image.h"

namespace foresight {

/// A copy that owns its pixels.
QImage QImageOf(const ColorImage& image);

}  // namespace foresight
