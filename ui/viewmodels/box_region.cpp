#include "ui/viewmodels/box_region.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foresight {
namespace {

constexpr std::size_t kMinPoints = 20;
constexpr double kBin_m = 0.1;
constexpr std::size_t kEmptyBins = 4;  // that much of nothing ends what is meant
constexpr double kStrayFraction =
    0.002;  // of the points under the rectangle; fewer in a bin are none
constexpr double kMargin_m = 0.01;
constexpr double kSlack = 0.002;  // of the points on each side of the box may be strays

struct SeenPoint {
  Eigen::Vector3d in_robot;
  double distance_m;
};

std::vector<SeenPoint> PointsUnder(const CloudRectangle& rectangle,
                                   std::span<const Eigen::Vector3f> points,
                                   const Rigid<frame::Robot, frame::Base>& robot_from_base,
                                   const BoxRoi* within) {
  std::vector<SeenPoint> seen;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d in_base = point.cast<double>();
    if (!in_base.allFinite() || (within != nullptr && !within->Contains(in_base))) continue;
    const Eigen::Vector3d in_robot = robot_from_base * in_base;
    const Eigen::Vector4d clip = rectangle.clip_from_robot * in_robot.homogeneous();
    if (clip.w() <= 0.0) continue;
    const Eigen::Vector2d at = clip.head<2>() / clip.w();
    if ((at.array() < rectangle.corners.low.array()).any() ||
        (at.array() > rectangle.corners.high.array()).any())
      continue;
    seen.push_back({in_robot, clip.w()});
  }
  return seen;
}

/// Where the nearest things end: the distance behind which nothing is for a while.
double FarEnd(const std::vector<SeenPoint>& seen) {
  const auto by_distance = [](const SeenPoint& a, const SeenPoint& b) {
    return a.distance_m < b.distance_m;
  };
  const auto [near, far] = std::minmax_element(seen.begin(), seen.end(), by_distance);
  const double begin_m = near->distance_m;
  std::vector<std::size_t> counts(static_cast<std::size_t>((far->distance_m - begin_m) / kBin_m) +
                                  1);
  for (const SeenPoint& point : seen)
    ++counts[static_cast<std::size_t>((point.distance_m - begin_m) / kBin_m)];
  const double least = std::max(3.0, kStrayFraction * static_cast<double>(seen.size()));
  std::size_t empty = 0;
  bool begun = false;
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    const bool holds = static_cast<double>(counts[bin]) >= least;
    begun = begun || holds;
    empty = holds ? 0 : empty + 1;
    if (begun && empty == kEmptyBins)
      return begin_m + kBin_m * static_cast<double>(bin + 1 - kEmptyBins);
  }
  return far->distance_m;
}

}  // namespace

std::optional<BoxRoi> BoxUnder(const CloudRectangle& rectangle,
                               std::span<const Eigen::Vector3f> points,
                               const Rigid<frame::Robot, frame::Base>& robot_from_base,
                               const BoxRoi* within) {
  std::vector<SeenPoint> seen = PointsUnder(rectangle, points, robot_from_base, within);
  if (seen.size() < kMinPoints) return std::nullopt;
  // Cutting a box must not also cut it in depth, which was settled when it was drawn.
  if (within == nullptr)
    std::erase_if(
        seen, [end_m = FarEnd(seen)](const SeenPoint& point) { return point.distance_m > end_m; });
  if (seen.size() < kMinPoints) return std::nullopt;
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  const auto slack = static_cast<std::ptrdiff_t>(kSlack * static_cast<double>(seen.size()));
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [axis](const SeenPoint& a, const SeenPoint& b) {
      return a.in_robot[axis] < b.in_robot[axis];
    };
    std::nth_element(seen.begin(), seen.begin() + slack, seen.end(), along);
    low[axis] = seen[static_cast<std::size_t>(slack)].in_robot[axis] - kMargin_m;
    std::nth_element(seen.begin(), seen.end() - 1 - slack, seen.end(), along);
    high[axis] = (seen.end() - 1 - slack)->in_robot[axis] + kMargin_m;
  }
  const Rigid<frame::Base, frame::Robot> base_from_robot = robot_from_base.Inverse();
  BoxRoi box;
  box.base_from_box = Rigid<frame::Base, frame::Object>(base_from_robot.rotation(),
                                                        base_from_robot * (0.5 * (low + high)));
  box.size_m = high - low;
  return box;
}

}  // namespace foresight
