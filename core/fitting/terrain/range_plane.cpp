#include "core/fitting/terrain/range_plane.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace foresight {

RangePlaneSums::RangePlaneSums(const Eigen::Vector3d& viewpoint, const Eigen::Vector3d& forward)
    : viewpoint_(viewpoint) {
  const Eigen::Vector3d ahead = forward.normalized();
  const Eigen::Vector3d other =
      std::abs(ahead.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d across = ahead.cross(other).normalized();
  axes_ << across.transpose(), ahead.cross(across).transpose(), ahead.transpose();
}

void RangePlaneSums::Add(const Eigen::Vector3d& point, double weight) {
  const Eigen::Vector3d seen = axes_ * (point - viewpoint_);
  if (!(seen.z() > 1e-6)) return;
  const double inverse = 1.0 / seen.z();
  const double a = seen.x() * inverse, b = seen.y() * inverse;
  normal_(0, 0) += weight;
  normal_(0, 1) += weight * a;
  normal_(0, 2) += weight * b;
  normal_(1, 1) += weight * a * a;
  normal_(1, 2) += weight * a * b;
  normal_(2, 2) += weight * b * b;
  right_ += weight * inverse * Eigen::Vector3d(1.0, a, b);
}

std::optional<Plane> RangePlaneSums::Solve() const {
  const double sum = normal_(0, 0);
  if (!(sum > 0.0)) return std::nullopt;
  const double mean_a = normal_(0, 1) / sum, mean_b = normal_(0, 2) / sum;
  const double aa = normal_(1, 1) / sum - mean_a * mean_a;
  const double ab = normal_(1, 2) / sum - mean_a * mean_b;
  const double bb = normal_(2, 2) / sum - mean_b * mean_b;
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-4 * (aa + bb) * (aa + bb)) || !(aa + bb > 1e-14)) return std::nullopt;
  const double mean = right_[0] / sum;
  const double ra = right_[1] / sum - mean_a * mean, rb = right_[2] / sum - mean_b * mean;
  const double ca = (bb * ra - ab * rb) / determinant, cb = (aa * rb - ab * ra) / determinant;
  const double c0 = mean - ca * mean_a - cb * mean_b;
  // m . (x - viewpoint) = 1 on the plane, so m points away from the viewpoint.
  const Eigen::Vector3d m = axes_.transpose() * Eigen::Vector3d(ca, cb, c0);
  const double length = m.norm();
  if (!(length > 1e-9)) return std::nullopt;
  const Eigen::Vector3d normal = -m / length;
  return Plane{normal, normal.dot(viewpoint_) - 1.0 / length};
}

double RangeTo(const Plane& plane, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
  const double closing = -plane.normal.dot(direction);
  const double height = plane.Distance(origin);
  return closing > 1e-3 && height > 0.0 ? height / closing
                                        : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace foresight
