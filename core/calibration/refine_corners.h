#pragma once

#include "core/calibration/corner_grid.h"

namespace foresight {

/// Of a window that is good to hundredths of a pixel: in larger ones the edges of a fisheye image
/// bend.
inline constexpr double kLargestReach_px = 8.0;

/// The corner of a checkerboard next to `guess`: the point at which the image's gradients in a
/// window of +- reach_px pass by sideways; `guess` itself where there is none in the window.
/// nullopt outside of the image.
std::optional<Eigen::Vector2d> RefineCorner(const GrayImage& image, const Eigen::Vector2d& guess,
                                            double reach_px);

/// The same for all corners of a grid, each in a window that fits the squares around it. A corner
/// without an answer stays where it was.
void RefineCorners(const GrayImage& image, CornerGrid& grid);

}  // namespace foresight
