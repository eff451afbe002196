#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/pictures/cloud_picture.h"

namespace foresight {

/// (X/Z, Y/Z) of what a pixel sees, in the camera's frame; NaN where it sees nothing.
using RayOfPixel = std::function<Eigen::Vector2d(const Eigen::Vector2d& pixel)>;

/// The pixels that have a depth and that the mask keeps as points in the camera's frame, with the
/// colours of the guide. `mask` may be null: nothing is masked. All images have one size.
std::vector<ColoredPoint> PointsOfDepth(const DepthImage& depth_m, const MaskImage* mask,
                                        const ColorImage& guide, const RayOfPixel& ray);

/// A view on points of a camera's frame from above and aside, so that depth errors which the camera
/// itself cannot show stand out. It turns about the middle of the points, and is just wide enough
/// for nearly all of them. At least one point.
CloudView ObliqueViewOf(const std::vector<ColoredPoint>& points, int width, int height);

}  // namespace foresight
