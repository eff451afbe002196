#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/geometry/plane.h"

namespace foresight {

/// Least-squares plane through ranges: what is noisy is how far a ray went, not where it pointed.
/// Inverse depth is linear in the rays' slopes on a plane, so the sums of a regression are all that
/// is kept. Depth is along `forward`, from `viewpoint`.
class RangePlaneSums {
 public:
  RangePlaneSums(const Eigen::Vector3d& viewpoint, const Eigen::Vector3d& forward);

  /// Adds a point in front of the viewpoint; others are ignored.
  void Add(const Eigen::Vector3d& point, double weight);
  double weight() const { return normal_(0, 0); }

  /// The plane, its normal towards the viewpoint; nullopt when the points lie on a line or the
  /// plane passes the viewpoint.
  std::optional<Plane> Solve() const;

 private:
  Eigen::Vector3d viewpoint_;
  Eigen::Matrix3d axes_;  ///< rows: two across, then forward
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
};

/// Where the ray from `origin` along `direction` intersects the plane; NaN when it runs along it,
/// away from it or comes from behind.
double RangeTo(const Plane& plane, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

}  // namespace foresight
