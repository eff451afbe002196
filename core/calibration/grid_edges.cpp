#include "core/calibration/grid_edges.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/corner_grid.h"

namespace foresight {

int LightSide(const GrayImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double least_contrast) {
  const Eigen::Vector2d along = to - from;
  const double length = along.norm();
  const Eigen::Vector2d aside =
      std::max(1.5, 0.12 * length) / length * Eigen::Vector2d(-along.y(), along.x());
  int side = 0;
  for (const double t : {0.12, 0.25, 0.35, 0.42, 0.5, 0.58, 0.65, 0.75, 0.88}) {
    const auto one = GreyAt(image, from + t * along + aside);
    const auto other = GreyAt(image, from + t * along - aside);
    if (!one || !other || std::abs(*one - *other) < least_contrast) return 0;
    const int here = *one > *other ? 1 : -1;
    if (side != 0 && here != side) return 0;
    side = here;
  }
  return side;
}

bool IsEdge(const GrayImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
            double least_contrast) {
  return LightSide(image, from, to, least_contrast) != 0;
}

}  // namespace foresight
