#include "core/pictures/depth_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/contract.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kAside_rad = 0.40;
constexpr double kAbove_rad = 0.22;
/// This share of the points may lie outside the picture, in each direction.
constexpr double kOutside = 0.01;
constexpr double kLeastTangent = 0.05;
constexpr double kMargin = 1.03;

/// The value below which `share` of the values lie.
double Quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Halfway between the points' outermost coordinates, outliers left out.
Eigen::Vector3d MiddleOf(const std::vector<ColoredPoint>& points) {
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const ColoredPoint& point : points) values.push_back(point.position[axis]);
    middle[axis] = 0.5 * (Quantile(values, kOutside) + Quantile(values, 1.0 - kOutside));
  }
  return middle;
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
  view.target = MiddleOf(points);
  const Eigen::AngleAxisd aside(-kAside_rad, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd above(-kAbove_rad, Eigen::Vector3d::UnitX());
  view.eye = view.target + aside * (above * Eigen::Vector3d(0.0, 0.0, -view.target.norm()));

  // At 90 deg a point's place in the picture, from its middle, is its tangent in half widths.
  CloudView wide = view;
  wide.field_of_view_rad = RadiansFromDegrees(90.0);
  std::vector<double> tangents;
  tangents.reserve(points.size());
  for (const ColoredPoint& point : points) {
    const Eigen::Vector2d pixel = ProjectToCloudPicture(point.position.cast<double>(), wide);
    if (!pixel.allFinite()) continue;
    const Eigen::Vector2d offset = (pixel - 0.5 * Eigen::Vector2d(width, height)) * 2.0 / width;
    tangents.push_back(std::max(std::abs(offset.x()), std::abs(offset.y()) * width / height));
  }
  const double tangent = tangents.empty() ? 1.0 : Quantile(tangents, 1.0 - 2.0 * kOutside);
  view.field_of_view_rad = 2.0 * std::atan(kMargin * std::max(kLeastTangent, tangent));
  return view;
}

}  // namespace foresight
