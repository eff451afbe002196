#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/base/random.h"

namespace foresight {

/// All x with normal . x = offset; the normal has length 1.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0.0;

  /// Signed distance of a point, positive on the side the normal points to.
  double Distance(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

/// Least-squares plane through at least 3 points; nullopt when they are fewer or lie on a line.
std::optional<Plane> FitPlane(std::span<const Eigen::Vector3d> points);

struct PlaneSearchOptions {
  double inlier_distance_m = 0.03;
  int iterations = 300;
  int min_inliers = 20;
};

/// The plane with most points within inlier_distance_m (RANSAC), refined by least squares on them.
std::optional<Plane> FindDominantPlane(std::span<const Eigen::Vector3d> points,
                                       const PlaneSearchOptions& options, Random& random);

}  // namespace foresight
