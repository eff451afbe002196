#include "core/fitting/terrain/block_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kInnerFrom_m = 0.005, kOuterFrom_m = 0.010;  // where bands along an edge begin
constexpr double kMinBand_m = 0.032, kMaxBand_m = 0.080;
constexpr double kCorner_m = 0.025;  // left out at both ends
constexpr double kMinInner = 0.50;
constexpr double kMaxOuter = 0.20;
constexpr double kMinSeen = 0.30;
constexpr double kNearEdge_m = 0.010;  // support this near outside is the edge's noise
constexpr double kAround_m = 0.120;

// What no number of points averages away: of a plane fitted to lidar ranges or to a dense map.
// Where a top ends: creases and flying points shift it, more so along the line of sight, where a
// footprint is stretched over the plane.
constexpr double kEdgeFloor_m = 0.004, kEdgeFloorAlongSight_m = 0.0075;
constexpr double kFootprintRatio = 0.25;  // of a stretched footprint's length
// A head that is not quite where it is believed to be and ranges that walk move all tops alike.
constexpr double kHeightFloor_m = 0.0015;
constexpr double kTiltFloor_rad = RadiansFromDegrees(0.15);
constexpr double kUnknownPlace_m = 0.030;
constexpr double kUnknownYaw_rad = RadiansFromDegrees(6.0);

/// A band must be wide enough for beams to fall into it.
double BandWidth(const SurfaceGrid& grid, const PlaneView& view) {
  const Eigen::Vector3d sight = view.surface.center - grid.viewpoint();
  const double spacing_m =
      LengthOn(view.surface.plane, sight.normalized(), sight.norm(), grid.step_rad().maxCoeff());
  return std::clamp(1.2 * spacing_m, kMinBand_m, kMaxBand_m);
}

/// Distance beyond edge `e` (negative inside) and place along it.
Eigen::Vector2d AtEdge(const Eigen::Vector2d& local, const Eigen::Vector2d& half, int e) {
  const double sign = e < 2 ? 1.0 : -1.0;
  const int axis = e % 2;
  return {sign * local[axis] - half[axis], local[1 - axis]};
}

void AddToBands(const Eigen::Vector2d& local, double area_m2, const Eigen::Vector2d& half,
                double band_m, double BlockEdge::*outer, bool support,
                std::array<BlockEdge, 4>& edges) {
  for (int e = 0; e < 4; ++e) {
    const Eigen::Vector2d at = AtEdge(local, half, e);
    if (std::abs(at[1]) > half[1 - e % 2] - kCorner_m) continue;
    BlockEdge& edge = edges[static_cast<std::size_t>(e)];
    if (at[0] > kOuterFrom_m && at[0] < kOuterFrom_m + band_m) edge.*outer += area_m2;
    if (support && -at[0] > kInnerFrom_m && -at[0] < kInnerFrom_m + band_m)
      edge.inner_support += area_m2;
  }
}

void ToFractions(const Eigen::Vector2d& half, double band_m, std::array<BlockEdge, 4>& edges) {
  for (int e = 0; e < 4; ++e) {
    const double length = 2.0 * (half[1 - e % 2] - kCorner_m);
    const double outer = length * band_m;
    BlockEdge& edge = edges[static_cast<std::size_t>(e)];
    edge.inner_support /= length * band_m;
    edge.outer_support /= outer;
    edge.outer_through /= outer;
    edge.outer_occupied /= outer;
  }
}

/// How far apart 2 % and 98 % of the values lie, stretched to all of them.
double Extent(std::vector<double>& values) {
  if (values.size() < 20) return 0.0;
  const std::size_t cut = values.size() / 50;
  const double low = MoveToRank(values, cut);
  return (MoveToRank(values, values.size() - 1 - cut) - low) / 0.96;
}

}  // namespace

bool BlockEdge::Confirmed() const {
  return inner_support >= kMinInner && outer_support <= kMaxOuter &&
         outer_through + outer_occupied >= kMinSeen;
}

bool BlockEdge::Drops() const {
  return Confirmed() && outer_through >= kMinSeen;
}

RectangleEvidence GatherEvidence(const SurfaceGrid& grid, const PlaneView& view,
                                 const BlockRectangle& rectangle) {
  RectangleEvidence evidence;
  BlockEvidence& block = evidence.block;
  const Eigen::Vector2d half = 0.5 * rectangle.size_m;
  const double band_m = BandWidth(grid, view);
  std::vector<double> along, across;
  double squares = 0.0;
  for (const auto& sample : view.support) {
    const Eigen::Vector2d local = rectangle.Local(sample.at);
    const double inside = (half - local.cwiseAbs()).minCoeff();
    AddToBands(local, sample.area_m2, half, band_m, &BlockEdge::outer_support, true,
               evidence.edges);
    if (inside < -kNearEdge_m && inside > -kAround_m) block.outside += sample.area_m2;
    if (inside > -kAround_m) {
      if (std::abs(local.y()) < half.y() - kCorner_m) along.push_back(local.x());
      if (std::abs(local.x()) < half.x() - kCorner_m) across.push_back(local.y());
    }
    if (inside < 0.0) continue;
    ++block.points;
    block.cover += sample.area_m2;
    const double error = view.surface.plane.Distance(grid[sample.point].point);
    squares += error * error;
  }
  for (const auto& sample : view.through) {
    const Eigen::Vector2d local = rectangle.Local(sample.at);
    AddToBands(local, sample.area_m2, half, band_m, &BlockEdge::outer_through, false,
               evidence.edges);
    if ((half - local.cwiseAbs()).minCoeff() > kNearEdge_m) block.see_through += sample.area_m2;
  }
  for (const auto& sample : view.occupied)
    AddToBands(rectangle.Local(sample.at), sample.area_m2, half, band_m, &BlockEdge::outer_occupied,
               false, evidence.edges);
  ToFractions(half, band_m, evidence.edges);
  const double area = rectangle.size_m.prod();
  block.cover = std::min(1.0, block.cover / area);
  block.see_through /= area;
  block.outside /= area;
  block.rms_m = std::sqrt(squares / std::max(1, block.points));
  for (const BlockEdge& edge : evidence.edges) {
    block.confirmed_edges += edge.Confirmed() ? 1 : 0;
    evidence.dropping_edges += edge.Drops() ? 1 : 0;
  }
  evidence.size_error_m = std::max(std::abs(Extent(along) - rectangle.size_m.x()),
                                   std::abs(Extent(across) - rectangle.size_m.y()));
  return evidence;
}

PoseCovariance BlockCovariance(const SurfaceGrid& grid, const PlaneView& view,
                               const BlockRectangle& rectangle, const RectangleEvidence& evidence,
                               double blur_m) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  double spacing_m = 0.0;
  for (const auto& sample : view.support) {
    const Eigen::Vector2d local = rectangle.Local(sample.at);
    if ((0.5 * rectangle.size_m - local.cwiseAbs()).minCoeff() < 0.0) continue;
    const double sigma = DistanceSigma(grid, sample.point, view.surface.plane);
    const Eigen::Vector3d by_pose(1.0, local.y(), -local.x());
    information += grid.samples_per_point() / (sigma * sigma) * by_pose * by_pose.transpose();
    spacing_m += std::sqrt(sample.area_m2);
  }
  spacing_m /= std::max(1, evidence.block.points);
  const Eigen::Matrix3d of_plane = information.ldlt().solve(Eigen::Matrix3d::Identity());
  PoseCovariance covariance = PoseCovariance::Zero();
  const std::array<int, 3> plane_rows = {2, 3, 4};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      covariance(plane_rows[static_cast<std::size_t>(r)], plane_rows[static_cast<std::size_t>(c)]) =
          of_plane(r, c);
  covariance(2, 2) += kHeightFloor_m * kHeightFloor_m;
  for (const int row : {3, 4}) covariance(row, row) += kTiltFloor_rad * kTiltFloor_rad;
  const Eigen::Vector3d factors(1.0, kTiltSigmaFactor, kTiltSigmaFactor);
  covariance.block<3, 3>(2, 2) =
      (factors.asDiagonal() * covariance.block<3, 3>(2, 2) * factors.asDiagonal()).eval();

  const Eigen::Vector3d sight = view.InBase(rectangle.center) - grid.viewpoint();
  const Eigen::Vector2d flat_sight(view.x.dot(sight), view.y.dot(sight));
  const Eigen::Vector2d along_sight =
      (Eigen::Rotation2Dd(-rectangle.yaw_rad) * flat_sight).normalized();
  const double footprint_m =
      LengthOn(view.surface.plane, sight.normalized(), sight.norm(), grid.footprint_height_rad());
  double yaw_information = 1.0 / (kUnknownYaw_rad * kUnknownYaw_rad);
  for (int axis = 0; axis < 2; ++axis) {
    double place_information = 1.0 / (kUnknownPlace_m * kUnknownPlace_m);
    const double length = rectangle.size_m[1 - axis];
    const double sharp_m = std::hypot(
        kEdgeFloor_m,
        along_sight[axis] * std::hypot(kEdgeFloorAlongSight_m, kFootprintRatio * footprint_m));
    for (const int e : {axis, axis + 2}) {
      if (!evidence.edges[static_cast<std::size_t>(e)].Confirmed()) continue;
      // Each point along the edge tells where it is to within its spacing and the blur.
      const double samples =
          std::max(1.0, grid.samples_per_point() * length / std::max(1e-4, spacing_m));
      const double variance =
          (spacing_m * spacing_m / 12.0 + blur_m * blur_m) / samples + sharp_m * sharp_m;
      place_information += 1.0 / variance;
      yaw_information += length * length / 12.0 / variance;
    }
    covariance(axis, axis) = 1.0 / place_information;
  }
  covariance(5, 5) = 1.0 / yaw_information;
  return covariance;
}

}  // namespace foresight
