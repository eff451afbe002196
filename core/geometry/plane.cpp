#include "core/geometry/plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace foresight {

std::optional<Plane> FitPlane(std::span<const Eigen::Vector3d> points) {
  if (points.size() < 3) return std::nullopt;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& point : points) covariance += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d spread = solver.eigenvalues();
  if (!(spread[1] > 1e-12 * std::max(spread[2], 1e-300))) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return Plane{normal, normal.dot(mean)};
}

std::optional<Plane> FindDominantPlane(std::span<const Eigen::Vector3d> points,
                                       const PlaneSearchOptions& options, Random& random) {
  const int count = static_cast<int>(points.size());
  if (count < 3) return std::nullopt;
  const auto inliers = [&](const Plane& plane) {
    std::vector<Eigen::Vector3d> near;
    for (const auto& point : points)
      if (std::abs(plane.Distance(point)) < options.inlier_distance_m) near.push_back(point);
    return near;
  };
  std::optional<Plane> best;
  std::size_t best_count = 0;
  for (int i = 0; i < options.iterations; ++i) {
    const Eigen::Vector3d& a = points[random.Index(count)];
    const Eigen::Vector3d& b = points[random.Index(count)];
    const Eigen::Vector3d& c = points[random.Index(count)];
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    if (cross.norm() < 1e-9) continue;
    const Eigen::Vector3d normal = cross.normalized();
    const Plane plane{normal, normal.dot(a)};
    std::size_t near = 0;
    for (const auto& point : points)
      near += std::abs(plane.Distance(point)) < options.inlier_distance_m ? 1 : 0;
    if (near > best_count) {
      best_count = near;
      best = plane;
    }
  }
  if (!best || static_cast<int>(best_count) < options.min_inliers) return std::nullopt;
  for (int round = 0; round < 3; ++round)
    if (const auto refined = FitPlane(inliers(*best))) best = refined;
  return best;
}

}  // namespace foresight
