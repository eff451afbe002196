#include "core/pictures/depth_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/contract.h"
#include "core/base/quantile.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kAside_rad = 0.40;
constexpr double kAbove_rad = 0.22;
/// This fraction of the points may lie outside the picture, in each direction.
constexpr double kOutside = 0.01;
constexpr double kLeastTangent = 0.05;
constexpr double kMargin = 1.03;
/// In half diagonals of the points' box.
constexpr double kLeastDistance = 1.5;

/// The points' outermost coordinates, outliers left out.
Eigen::AlignedBox3d BoxOf(const std::vector<ColoredPoint>& points) {
  Eigen::Vector3d low, high;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const ColoredPoint& point : points) values.push_back(point.position[axis]);
    low[axis] = Quantile(values, kOutside);
    high[axis] = Quantile(std::move(values), 1.0 - kOutside);
  }
  return {low, high};
}

/// Where nearly all of the points appear, as tangents of the angles from the view's axis.
struct Extent {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

Extent ExtentOf(const std::vector<ColoredPoint>& points, CloudView view) {
  // At 90 deg a point's place in the picture, from its middle, is its tangent in half widths.
  view.field_of_view_rad = RadiansFromDegrees(90.0);
  std::vector<double> across, down;
  for (const ColoredPoint& point : points) {
    const Eigen::Vector2d pixel = ProjectToCloudPicture(point.position.cast<double>(), view);
    if (!pixel.allFinite()) continue;
    across.push_back(2.0 * pixel.x() / view.width - 1.0);
    down.push_back((2.0 * pixel.y() - view.height) / view.width);
  }
  if (across.empty()) return {Eigen::Vector2d::Constant(-1.0), Eigen::Vector2d::Constant(1.0)};
  return {{Quantile(across, kOutside), Quantile(down, kOutside)},
          {Quantile(across, 1.0 - kOutside), Quantile(down, 1.0 - kOutside)}};
}

/// Turns the view so that the middle of `extent` comes to its centre.
void AimAtMiddle(const Extent& extent, CloudView& view) {
  const Eigen::Vector2d middle = 0.5 * (extent.low + extent.high);
  const Eigen::Vector3d forward = (view.target - view.eye).normalized();
  const Eigen::Vector3d right = forward.cross(view.up).normalized();
  const Eigen::Vector3d down = forward.cross(right);
  const double distance = (view.target - view.eye).norm();
  view.target = view.eye + distance * (forward + middle.x() * right + middle.y() * down);
}

}  // namespace

std::vector<ColoredPoint> PointsOfDepth(const DepthImage& depth_m, const MaskImage* mask,
                                        const ColorImage& guide, const RayOfPixel& ray) {
  FORESIGHT_EXPECTS(depth_m.SameSize(guide) && (mask == nullptr || depth_m.SameSize(*mask)),
                    "depth, mask and guide have one size");
  std::vector<ColoredPoint> points;
  for (int y = 0; y < depth_m.height(); ++y)
    for (int x = 0; x < depth_m.width(); ++x) {
      const float depth = depth_m(x, y);
      if (!std::isfinite(depth) || (mask != nullptr && (*mask)(x, y) == 0)) continue;
      const Eigen::Vector2d slope = ray(Eigen::Vector2d(x, y));
      if (!slope.allFinite()) continue;
      points.push_back({Eigen::Vector3f(static_cast<float>(slope.x()) * depth,
                                        static_cast<float>(slope.y()) * depth, depth),
                        guide(x, y)});
    }
  return points;
}

CloudView ObliqueViewOf(const std::vector<ColoredPoint>& points, int width, int height) {
  FORESIGHT_EXPECTS(!points.empty(), "a view needs something to look at");
  CloudView view;
  view.width = width;
  view.height = height;
  const Eigen::AlignedBox3d box = BoxOf(points);
  view.target = box.center();
  // From as far as the camera, but never so near to a wide scene that its ends lie behind the eye.
  const double distance =
      std::max(view.target.norm(), kLeastDistance * 0.5 * box.diagonal().norm());
  const Eigen::AngleAxisd aside(-kAside_rad, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd above(-kAbove_rad, Eigen::Vector3d::UnitX());
  view.eye = view.target + aside * (above * Eigen::Vector3d(0.0, 0.0, -distance));

  AimAtMiddle(ExtentOf(points, view), view);
  const Extent extent = ExtentOf(points, view);
  const Eigen::Vector2d half = extent.low.cwiseAbs().cwiseMax(extent.high.cwiseAbs());
  const double tangent = std::max({kLeastTangent, half.x(), half.y() * width / height});
  view.field_of_view_rad = 2.0 * std::atan(kMargin * tangent);
  return view;
}

}  // namespace foresight
