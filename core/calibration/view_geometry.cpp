#include "core/calibration/view_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Corners must reach beyond the middle by this fraction of the image, on each side.
constexpr double kBeyondMiddle = 0.05;

Eigen::Vector3d Middle(const CalibrationBoard& board) {
  return 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
}

}  // namespace

CornerCoverage CoverageOf(const std::vector<BoardView>& views, int width, int height) {
  CornerCoverage coverage;
  for (const BoardView& view : views)
    for (const Eigen::Vector2d& pixel : view.pixels) {
      const double x = (pixel.x() + 0.5) / width, y = (pixel.y() + 0.5) / height;
      coverage.left = std::min(coverage.left, x);
      coverage.right = std::max(coverage.right, x);
      coverage.top = std::min(coverage.top, y);
      coverage.bottom = std::max(coverage.bottom, y);
    }
  return coverage;
}

std::string CoverageFault(const CornerCoverage& coverage) {
  const auto fault = [](const char* side, double fraction) {
    return fmt::format("all corners lie in the {} {:.0f} % of the image", side, 100.0 * fraction);
  };
  if (coverage.right < 0.5 + kBeyondMiddle) return fault("left", coverage.right);
  if (coverage.left > 0.5 - kBeyondMiddle) return fault("right", 1.0 - coverage.left);
  if (coverage.bottom < 0.5 + kBeyondMiddle) return fault("upper", coverage.bottom);
  if (coverage.top > 0.5 - kBeyondMiddle) return fault("lower", 1.0 - coverage.top);
  return {};
}

double LargestTilt(const CameraBundle& bundle) {
  double largest = 0.0;
  for (const CameraFromPattern& pose : bundle.poses) {
    const Eigen::Vector3d sight = (pose * Middle(bundle.board)).normalized();
    const Eigen::Vector3d normal = pose.Rotate(Eigen::Vector3d::UnitZ());
    largest = std::max(largest, std::acos(std::min(1.0, std::abs(normal.dot(sight)))));
  }
  return largest;
}

std::string DescribeViews(const CameraBundle& bundle) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const CameraFromPattern& pose : bundle.poses) {
    const double distance = (pose * Middle(bundle.board)).norm();
    nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  const CornerCoverage coverage =
      CoverageOf(bundle.views, bundle.camera.width, bundle.camera.height);
  return fmt::format(
      "boards are tilted by up to {:.0f} deg against the line of sight, {:.2f} to {:.2f} m away, "
      "and cover {:.0f} to {:.0f} % of the width and {:.0f} to {:.0f} % of the height",
      DegreesFromRadians(LargestTilt(bundle)), nearest, farthest, 100.0 * coverage.left,
      100.0 * coverage.right, 100.0 * coverage.top, 100.0 * coverage.bottom);
}

}  // namespace foresight
