#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/image.h"

namespace foresight {

/// Lines through pixel coordinates, smoothed; parts outside the image are cut off.
void DrawPolylines(ColorImage& image, const std::vector<std::vector<Eigen::Vector2d>>& lines,
                   Rgb8 color, int thickness_px);

/// A closed polygon's outline.
void DrawPolygon(ColorImage& image, const std::vector<Eigen::Vector2d>& corners, Rgb8 color,
                 int thickness_px);

void DrawDot(ColorImage& image, const Eigen::Vector2d& center, int radius_px, Rgb8 color);

}  // namespace foresight
