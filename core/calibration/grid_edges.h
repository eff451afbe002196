#pragma once

#include <Eigen/Core>

#include "core/base/image.h"

namespace foresight {

/// Fraction of the corners' contrast that a sharp edge between them has all along.
inline constexpr double kEdgeContrast = 0.35;

/// Light on which side of the way from one to the other: 1 = on the side that angles grow to, -1 =
/// on the other, 0 = neither, or not all along.
int LightSide(const GrayImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double least_contrast);

/// Whether two neighbouring corners of a grid have an edge between squares all along between them,
/// as those of one board do; across the gap between two boards there is none.
bool IsEdge(const GrayImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
            double least_contrast);

}  // namespace foresight
