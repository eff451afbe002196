#include "core/calibration/refine_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace foresight {
namespace {

/// The window's half side: large windows average more noise.
constexpr double kReachPerSpacing = 0.3;
constexpr double kSmallestReach_px = 2.0;

/// Distance to the nearest of the (up to) four neighbours.
double Spacing(const CornerGrid& grid, int column, int row) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](int c, int r) {
    if (c < 0 || r < 0 || c >= grid.columns || r >= grid.rows) return;
    least = std::min(least, (grid.At(c, r) - grid.At(column, row)).norm());
  };
  look(column - 1, row);
  look(column + 1, row);
  look(column, row - 1);
  look(column, row + 1);
  return least;
}

}  // namespace

std::optional<Eigen::Vector2d> RefineCorner(const GrayImage& image, const Eigen::Vector2d& guess,
                                            double reach_px) {
  if (!(guess.x() >= 0.0) || !(guess.y() >= 0.0) || !(guess.x() <= image.width() - 1.0) ||
      !(guess.y() <= image.height() - 1.0))
    return std::nullopt;
  const int half = static_cast<int>(std::lround(std::max(reach_px, kSmallestReach_px)));
  if (image.width() < 2 * half + 5 || image.height() < 2 * half + 5) return std::nullopt;
  const cv::Mat pixels(image.height(), image.width(), CV_8UC1,
                       const_cast<std::uint8_t*>(image.data()));  // never written
  const cv::Point2f start(static_cast<float>(guess.x()), static_cast<float>(guess.y()));
  std::vector<cv::Point2f> point = {start};
  cv::cornerSubPix(pixels, point, {half, half}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::MAX_ITER, 60, 1e-4});
  const Eigen::Vector2d corner(point[0].x, point[0].y);
  // OpenCV leaves the point where it was when the search left the window.
  if ((corner - guess).cwiseAbs().maxCoeff() > half) return std::nullopt;
  return corner;
}

void RefineCorners(const GrayImage& image, CornerGrid& grid) {
  CornerGrid refined = grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double reach = std::clamp(kReachPerSpacing * Spacing(grid, column, row),
                                      kSmallestReach_px, kLargestReach_px);
      if (const auto corner = RefineCorner(image, grid.At(column, row), reach))
        refined.At(column, row) = *corner;
    }
  grid = std::move(refined);
}

}  // namespace foresight
