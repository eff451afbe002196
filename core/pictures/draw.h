#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace foresight {

/// Lines through pixel coordinates, smoothed; parts outside the image are cut off.
void DrawPolylines(ColorImage& image, const std::vector<std::vector<Eigen::Vector2d>>& lines,
                   Rgb8 color, int thickness_px);

}  // namespace foresight
