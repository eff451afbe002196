#include "core/fitting/terrain/surface_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/quantile.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr double kMaxCells = 8e6;
constexpr double kLeastStep_rad = 1e-4;

bool Usable(const RangeRay& ray) {
  return ray.origin.allFinite() && ray.direction.allFinite() && std::isfinite(ray.range_m) &&
         ray.range_m > 0.0 && std::abs(ray.direction.norm() - 1.0) < 1e-3;
}

GridPoint PointOf(const RangeRay& ray, int index, const Eigen::Vector2i& cell) {
  return {ray.origin, ray.direction, ray.Point(), ray.range_m, cell, 0.0, index};
}

/// Cells of all usable rays, or nothing when one has none or they do not make a grid.
std::vector<Eigen::Vector2i> MeasuredCells(const RaySet& rays) {
  std::vector<Eigen::Vector2i> cells;
  Eigen::Vector2i low = Eigen::Vector2i::Constant(std::numeric_limits<int>::max());
  Eigen::Vector2i high = Eigen::Vector2i::Zero();
  for (const RangeRay& ray : rays.rays) {
    if (!Usable(ray)) continue;
    if (ray.cell.x() < 0 || ray.cell.y() < 0) return {};
    cells.push_back(ray.cell);
    low = low.cwiseMin(ray.cell);
    high = high.cwiseMax(ray.cell);
  }
  if (cells.empty()) return {};
  const Eigen::Vector2d extent = (high - low).cast<double>() + Eigen::Vector2d::Ones();
  if (extent.prod() > kMaxCells) return {};
  for (Eigen::Vector2i& cell : cells) cell -= low;
  return cells;
}

}  // namespace

SurfaceGrid::SurfaceGrid(const RaySet& rays, int max_rays)
    : sigma_m_(rays.sigma_m),
      samples_per_point_(rays.samples_per_ray),
      footprint_height_rad_(rays.footprint_height_rad),
      viewpoint_(rays.viewpoint) {
  PutOnMeasuredGrid(rays, max_rays);
  if (points_.empty()) PutOnAngles(rays);
  MeasureSteps();
}

void SurfaceGrid::PutOnMeasuredGrid(const RaySet& rays, int max_rays) {
  const std::vector<Eigen::Vector2i> cells = MeasuredCells(rays);
  if (cells.empty()) return;
  const int stride =
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cells.size()) / max_rays)));
  std::size_t next = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    if (!Usable(rays.rays[i])) continue;
    const Eigen::Vector2i& cell = cells[next++];
    if (cell.x() % stride != 0 || cell.y() % stride != 0) continue;
    points_.push_back(PointOf(rays.rays[i], static_cast<int>(i), cell / stride));
  }
  samples_per_point_ = std::min(1.0, samples_per_point_ * stride * stride);
  BuildIndex();
}

void SurfaceGrid::PutOnAngles(const RaySet& rays) {
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : rays.rays)
    if (Usable(ray)) ahead += ray.direction;
  if (!(ahead.norm() > 0.0)) return;
  const Eigen::Quaterniond turn = RotationBetween(ahead, Eigen::Vector3d::UnitZ());
  std::vector<Eigen::Vector2d> angles;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(10.0), high = -low;
  for (const RangeRay& ray : rays.rays) {
    if (!Usable(ray)) continue;
    const Eigen::Vector3d seen = turn * ray.direction;
    const double away_rad = std::acos(std::clamp(seen.z(), -1.0, 1.0));
    const double length = std::max(1e-12, seen.head<2>().norm());
    angles.emplace_back(away_rad / length * seen.head<2>());
    low = low.cwiseMin(angles.back());
    high = high.cwiseMax(angles.back());
  }
  const Eigen::Vector2d extent = (high - low).cwiseMax(kLeastStep_rad);
  const double step =
      std::max({rays.footprint_rad, kLeastStep_rad, std::sqrt(extent.prod() / kMaxCells)});
  std::size_t next = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    if (!Usable(rays.rays[i])) continue;
    const Eigen::Vector2i cell = ((angles[next++] - low) / step).cast<int>();
    points_.push_back(PointOf(rays.rays[i], static_cast<int>(i), cell));
  }
  BuildIndex();
}

/// One point a cell: the nearest of those that share it, so that the order does not matter.
void SurfaceGrid::BuildIndex() {
  std::stable_sort(points_.begin(), points_.end(), [](const GridPoint& a, const GridPoint& b) {
    return std::tuple(a.cell.y(), a.cell.x(), a.range_m) <
           std::tuple(b.cell.y(), b.cell.x(), b.range_m);
  });
  const auto last = std::unique(points_.begin(), points_.end(),
                                [](const auto& a, const auto& b) { return a.cell == b.cell; });
  points_.erase(last, points_.end());
  for (const GridPoint& point : points_) {
    width_ = std::max(width_, point.cell.x() + 1);
    height_ = std::max(height_, point.cell.y() + 1);
  }
  index_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1);
  for (int i = 0; i < size(); ++i)
    index_[static_cast<std::size_t>((*this)[i].cell.y()) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>((*this)[i].cell.x())] = i;
}

void SurfaceGrid::MeasureSteps() {
  std::vector<double> across, down, area;
  for (int i = 0; i < size(); ++i) {
    GridPoint& here = points_[static_cast<std::size_t>(i)];
    const int x = Neighbor(i, 1, 0), y = Neighbor(i, 0, 1);
    const Eigen::Vector3d dx =
        x >= 0 ? Eigen::Vector3d((*this)[x].direction - here.direction) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d dy =
        y >= 0 ? Eigen::Vector3d((*this)[y].direction - here.direction) : Eigen::Vector3d::Zero();
    if (x >= 0) across.push_back(dx.norm());
    if (y >= 0) down.push_back(dy.norm());
    if (x < 0 || y < 0) continue;
    here.solid_angle_sr = dx.cross(dy).norm();
    area.push_back(here.solid_angle_sr);
  }
  if (!across.empty()) step_rad_.x() = std::max(kLeastStep_rad, UpperMedian(across));
  if (!down.empty()) step_rad_.y() = std::max(kLeastStep_rad, UpperMedian(down));
  const double usual = area.empty() ? step_rad_.prod() : UpperMedian(area);
  // A line measured twice, or a gap of the encoder, must not make a point count for many.
  for (GridPoint& point : points_) {
    double& angle = point.solid_angle_sr;
    angle = angle > 0.0 ? std::clamp(angle, 0.3 * usual, 2.0 * usual) : usual;
  }
}

}  // namespace foresight
