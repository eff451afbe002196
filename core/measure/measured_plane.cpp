#include "core/measure/measured_plane.h"

#include <cmath>

namespace foresight {

Result<MeasuredPlane> FitMeasuredPlane(std::span<const Eigen::Vector3d> points,
                                       const Eigen::Vector3d& seen_from,
                                       const MeasuredPlaneOptions& options) {
  if (static_cast<int>(points.size()) < options.min_inliers)
    return Fail(ErrorCode::kTooFewPoints, "{} points are too few for a plane: it takes {}",
                points.size(), options.min_inliers);
  PlaneSearchOptions search;
  search.inlier_distance_m = options.inlier_distance_m;
  search.min_inliers = options.min_inliers;
  Random random(1);
  const auto found = FindDominantPlane(points, search, random);
  if (!found)
    return Fail(ErrorCode::kNoConvergence, "the {} points lie in no plane", points.size());
  MeasuredPlane measured;
  measured.plane = *found;
  measured.points = static_cast<int>(points.size());
  double squares = 0.0;
  for (const Eigen::Vector3d& point : points) {
    const double distance = found->Distance(point);
    if (std::abs(distance) >= options.inlier_distance_m) continue;
    ++measured.inliers;
    squares += distance * distance;
    measured.centre += point;
  }
  if (measured.inliers < options.min_inliers ||
      measured.inliers < options.min_inlier_ratio * measured.points)
    return Fail(ErrorCode::kNoConvergence,
                "only {} of {} points lie in one plane: choose a flat place", measured.inliers,
                measured.points);
  measured.centre /= measured.inliers;
  measured.rms_m = std::sqrt(squares / measured.inliers);
  if (measured.plane.Distance(seen_from) < 0.0) {
    measured.plane.normal = -measured.plane.normal;
    measured.plane.offset = -measured.plane.offset;
  }
  return measured;
}

}  // namespace foresight
