#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/image.h"

namespace foresight {

struct ColoredPoint {
  Eigen::Vector3f position;  ///< metres
  Rgb8 color;
};

/// From where a cloud is looked at.
struct CloudView {
  Eigen::Vector3d eye = {0.0, 0.0, -1.0};
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = {0.0, -1.0, 0.0};
  double field_of_view_rad = 0.9;  ///< horizontal
  int width = 1200;
  int height = 800;
};

/// Draws a cloud as small squares, nearer ones in front, without any graphics library: for reports
/// made where there is no display.
ColorImage PaintCloud(std::span<const ColoredPoint> points, const CloudView& view);

/// Where a point of the cloud's frame appears in that picture; NaN behind the eye.
Eigen::Vector2d ProjectToCloudPicture(const Eigen::Vector3d& point, const CloudView& view);

}  // namespace foresight
