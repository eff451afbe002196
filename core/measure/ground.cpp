#include "core/measure/ground.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace foresight {
namespace {

constexpr double kBin_m = 0.05;
constexpr double kLevel = 0.966;  // cosine of 15 deg
constexpr double kLeastFraction = 0.05;
constexpr double kLeastSpread_m = 0.08;
constexpr std::size_t kMostPoints = 60'000;

/// The largest ground of the terrains.
std::optional<MeasuredPlane> GroundOf(std::span<const TerrainDetection* const> terrains,
                                      const SensorRig& rig) {
  std::optional<MeasuredPlane> best;
  double best_area = 0.0;
  for (const TerrainDetection* terrain : terrains)
    for (const TerrainSurface& surface : terrain->surfaces) {
      const double area = surface.size_m.x() * surface.size_m.y();
      if (surface.kind != TerrainSurface::Kind::kGround || area <= best_area) continue;
      best_area = area;
      const auto robot_from_object = rig.robot_from_base * surface.base_from_object;
      MeasuredPlane plane;
      plane.plane.normal = robot_from_object.Rotate(Eigen::Vector3d::UnitZ());
      plane.centre = robot_from_object.translation();
      plane.plane.offset = plane.plane.normal.dot(plane.centre);
      plane.rms_m = surface.evidence.rms_m;
      plane.inliers = plane.points = surface.evidence.points;
      plane.made_from = "the terrain's ground";
      best = plane;
    }
  return best;
}

/// How wide the plane's points spread across the direction in which they are the longest, as a
/// standard deviation: a strip of a wall lies in a level plane too, if it is thin enough.
double SpreadAcross(std::span<const Eigen::Vector3d> points, const Plane& plane) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double count = 0.0;
  for (const Eigen::Vector3d& point : points) {
    if (std::abs(plane.Distance(point)) >= MeasuredPlaneOptions().inlier_distance_m) continue;
    mean += point.head<2>();
    squares += point.head<2>() * point.head<2>().transpose();
    count += 1.0;
  }
  if (count < 1.0) return 0.0;
  mean /= count;
  const Eigen::Matrix2d covariance = squares / count - mean * mean.transpose();
  const double half_trace = 0.5 * covariance.trace();
  const double least =
      half_trace - std::sqrt(std::max(0.0, half_trace * half_trace - covariance.determinant()));
  return std::sqrt(std::max(0.0, least));
}

/// Returns below the sensor, thinned.
std::vector<Eigen::Vector3d> PointsBelow(const RegisteredScan& cloud, const SensorRig& rig) {
  std::vector<Eigen::Vector3d> points;
  const std::size_t stride = std::max<std::size_t>(1, cloud.points.size() / kMostPoints);
  const Eigen::Vector3d sensor = rig.robot_from_base.translation();
  for (std::size_t i = 0; i < cloud.points.size(); i += stride) {
    if (!cloud.points[i].allFinite()) continue;
    const Eigen::Vector3d point = rig.robot_from_base * cloud.points[i].cast<double>();
    if (point.z() < sensor.z()) points.push_back(point);
  }
  return points;
}

}  // namespace

Result<MeasuredPlane> FindGround(const RegisteredScan& cloud, const SensorRig& rig,
                                 std::span<const TerrainDetection* const> terrains) {
  if (auto ground = GroundOf(terrains, rig)) return *ground;
  const std::vector<Eigen::Vector3d> points = PointsBelow(cloud, rig);
  const Eigen::Vector3d sensor = rig.robot_from_base.translation();
  if (points.empty())
    return Fail(ErrorCode::kTooFewPoints, "no return lies below the sensor: there is no ground");
  // Slices by height, from below: a level plane fills one or two of them.
  const auto low = std::min_element(points.begin(), points.end(),
                                    [](const auto& a, const auto& b) { return a.z() < b.z(); });
  const double low_z = low->z();
  std::vector<std::vector<Eigen::Vector3d>> slices(
      static_cast<std::size_t>((sensor.z() - low_z) / kBin_m) + 1);
  for (const Eigen::Vector3d& point : points)
    slices[std::min(slices.size() - 1, static_cast<std::size_t>((point.z() - low_z) / kBin_m))]
        .push_back(point);
  const auto least = std::max<std::size_t>(
      60, static_cast<std::size_t>(kLeastFraction * static_cast<double>(points.size())));
  for (std::size_t i = 0; i < slices.size(); ++i) {
    // Three slices: a floor that tilts a little reaches over more than one.
    std::vector<Eigen::Vector3d> candidates;
    for (std::size_t j = i; j < std::min(slices.size(), i + 3); ++j)
      candidates.insert(candidates.end(), slices[j].begin(), slices[j].end());
    if (slices[i].size() < least / 4 || candidates.size() < least) continue;
    auto plane = FitMeasuredPlane(candidates, sensor, {.min_inlier_ratio = 0.5});
    if (!plane || plane->plane.normal.z() < kLevel || plane->inliers < static_cast<int>(least) ||
        SpreadAcross(candidates, plane->plane) < kLeastSpread_m)
      continue;
    // Once more with all that lies near it: the slices cut a tilted floor.
    std::vector<Eigen::Vector3d> near;
    for (const Eigen::Vector3d& point : points)
      if (std::abs(plane->plane.Distance(point)) < 0.06) near.push_back(point);
    if (auto refined = FitMeasuredPlane(near, sensor, {.min_inlier_ratio = 0.5});
        refined && refined->plane.normal.z() >= kLevel)
      plane = refined;
    plane->made_from = "the lowest level plane of the scan";
    return plane;
  }
  return Fail(ErrorCode::kTooFewPoints,
              "no level plane of the scan holds {} of the {} returns below the sensor", least,
              points.size());
}

}  // namespace foresight
