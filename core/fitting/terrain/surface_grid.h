#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/ray_set.h"

namespace foresight {

/// One measurement of a surface.
struct GridPoint {
  Eigen::Vector3d origin;     ///< of its ray, in base
  Eigen::Vector3d direction;  ///< of its ray, in base, length 1
  Eigen::Vector3d point;      ///< in base
  double range_m = 0.0;
  Eigen::Vector2i cell;         ///< on this grid
  double solid_angle_sr = 0.0;  ///< that it stands for
  int ray = -1;                 ///< index into the ray set
};

/// The rays of a region as neighbours of each other: on the grid they were measured on, or, for a
/// cloud without one, on a lattice of viewing angles as fine as its footprint. Unusable rays (not
/// finite, no range) are left out; a region of more than `max_rays` is thinned to every second,
/// third... cell in both directions.
class SurfaceGrid {
 public:
  SurfaceGrid(const RaySet& rays, int max_rays);

  int size() const { return static_cast<int>(points_.size()); }
  const std::vector<GridPoint>& points() const { return points_; }
  const GridPoint& operator[](int i) const { return points_[static_cast<std::size_t>(i)]; }

  /// The point in a cell; -1 = none, or outside.
  int At(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return -1;
    return index_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)];
  }
  /// The point `dx`, `dy` cells from a point; -1 = none.
  int Neighbor(int i, int dx, int dy) const {
    const Eigen::Vector2i& cell = points_[static_cast<std::size_t>(i)].cell;
    return At(cell.x() + dx, cell.y() + dy);
  }

  double sigma_m() const { return sigma_m_; }  ///< of a range
  const Eigen::Vector3d& viewpoint() const { return viewpoint_; }
  /// Median angle between neighbours in x and in y.
  const Eigen::Vector2d& step_rad() const { return step_rad_; }
  /// Full angle of a beam's footprint across its scan line; 0 where a point has no footprint of its
  /// own.
  double footprint_height_rad() const { return footprint_height_rad_; }
  /// Independent measurements behind a point, at most 1.
  double samples_per_point() const { return samples_per_point_; }

 private:
  void PutOnMeasuredGrid(const RaySet& rays, int max_rays);
  void PutOnAngles(const RaySet& rays);
  void BuildIndex();
  void MeasureSteps();

  std::vector<GridPoint> points_;
  std::vector<int> index_;
  int width_ = 0;
  int height_ = 0;
  double sigma_m_ = 0.0;
  double samples_per_point_ = 1.0;
  double footprint_height_rad_ = 0.0;
  Eigen::Vector3d viewpoint_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d step_rad_ = Eigen::Vector2d::Constant(1e-3);
};

}  // namespace foresight
