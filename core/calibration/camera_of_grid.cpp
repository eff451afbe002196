#include "core/calibration/camera_of_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/quantile.h"
#include "core/geometry/nearest_rotation.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

/// Points that have a pixel of their own.
struct Grid {
  std::span<const Eigen::Vector3d> points;
  std::size_t width = 0;
  double middle_u = 0.0;
  double middle_v = 0.0;
  double scale = 1.0;  ///< pixels to numbers of about 1

  Eigen::Vector2d PixelOf(std::size_t i) const {
    return {static_cast<double>(i % width), static_cast<double>(i / width)};
  }
};

/// The projection up to its scale: (u, v, 1) ~ M p, pixels from the middle.
Eigen::Matrix3d Projection(const Grid& grid, const std::vector<std::size_t>& used) {
  Matrix9 sum = Matrix9::Zero();
  for (const std::size_t i : used) {
    const Eigen::Vector3d ray = grid.points[i].normalized();
    const Eigen::Vector2d pixel = grid.PixelOf(i);
    const double u = (pixel.x() - grid.middle_u) / grid.scale;
    const double v = (pixel.y() - grid.middle_v) / grid.scale;
    Vector9 row = Vector9::Zero();
    row.segment<3>(0) = ray;
    row.segment<3>(6) = -u * ray;
    sum.selfadjointView<Eigen::Lower>().rankUpdate(row);
    row.segment<3>(0).setZero();
    row.segment<3>(3) = ray;
    row.segment<3>(6) = -v * ray;
    sum.selfadjointView<Eigen::Lower>().rankUpdate(row);
  }
  const Vector9 m = EigenOf(sum).vectors.col(0);
  Eigen::Matrix3d projection;
  projection << m.segment<3>(0).transpose(), m.segment<3>(3).transpose(),
      m.segment<3>(6).transpose();
  return projection;
}

/// How far from its own pixel each point appears by the projection, before it is known to be a
/// camera's.
std::vector<double> ErrorsOf(const Grid& grid, const std::vector<std::size_t>& used,
                             const Eigen::Matrix3d& projection) {
  std::vector<double> errors;
  for (const std::size_t i : used) {
    const Eigen::Vector3d image = projection * grid.points[i];
    const Eigen::Vector2d pixel =
        grid.scale * (image.head<2>() / image.z()) + Eigen::Vector2d(grid.middle_u, grid.middle_v);
    errors.push_back((pixel - grid.PixelOf(i)).norm());
  }
  return errors;
}

/// Leaves out what does not agree with the others: a depth camera has points between surfaces that
/// its software has moved.
Eigen::Matrix3d RobustProjection(const Grid& grid, std::vector<std::size_t>& used) {
  constexpr int kMostRounds = 8;
  constexpr double kMedians = 3.0;
  constexpr double kAlwaysKept_px = 0.1;
  for (int round = 0;; ++round) {
    const Eigen::Matrix3d projection = Projection(grid, used);
    const std::vector<double> errors = ErrorsOf(grid, used, projection);
    const double most = kMedians * UpperMedian(errors) + kAlwaysKept_px;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (errors[i] <= most) kept.push_back(used[i]);
    if (kept.size() == used.size() || round == kMostRounds || kept.empty()) return projection;
    used = std::move(kept);
  }
}

}  // namespace

std::optional<GridCamera> CameraOfGrid(std::span<const Eigen::Vector3d> points, int width) {
  constexpr std::size_t kLeastPoints = 100;
  constexpr double kLeastRatio = 0.7;  ///< of the points, that agree
  constexpr double kMostOff_px = 0.5;  ///< rms; pixels that are rounded alone make 0.4
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite() && !points[i].isZero()) used.push_back(i);
  const std::size_t all = used.size();
  if (width < 2 || all < kLeastPoints) return std::nullopt;
  const auto height = static_cast<int>(points.size() / static_cast<std::size_t>(width));
  if (height < 2) return std::nullopt;
  const Grid grid{points, static_cast<std::size_t>(width), 0.5 * (width - 1), 0.5 * (height - 1),
                  0.5 * width};
  Eigen::Matrix3d m = RobustProjection(grid, used);
  if (static_cast<double>(used.size()) < kLeastRatio * static_cast<double>(all))
    return std::nullopt;
  double ahead = 0.0;
  for (const std::size_t i : used) ahead += m.row(2).dot(points[i]) > 0.0 ? 1.0 : -1.0;
  m *= (ahead < 0.0 ? -1.0 : 1.0) / m.row(2).norm();
  const Eigen::Vector3d z = m.row(2).transpose();
  const double cx = m.row(0).dot(z), cy = m.row(1).dot(z);
  const Eigen::Vector3d x = m.row(0).transpose() - cx * z, y = m.row(1).transpose() - cy * z;
  if (!(x.norm() > 1e-3 && y.norm() > 1e-3)) return std::nullopt;
  Eigen::Matrix3d axes;
  axes << x.normalized().transpose(), y.normalized().transpose(), z.transpose();
  if (!(axes.determinant() > 0.5)) return std::nullopt;  // mirrored, or no camera's
  GridCamera found;
  found.camera = PinholeCamera(width, height, 1.0, grid.scale * cx + grid.middle_u,
                               grid.scale * cy + grid.middle_v);
  found.camera.fx = grid.scale * x.norm();
  found.camera.fy = grid.scale * y.norm();
  found.camera_from_cloud =
      Rigid<frame::Camera, frame::Robot>(NearestRotation(axes), Eigen::Vector3d::Zero());
  if (!found.camera.Check()) return std::nullopt;
  double sum = 0.0;
  for (const std::size_t i : used) {
    const auto pixel = found.camera.Project(found.camera_from_cloud * points[i]);
    if (!pixel) return std::nullopt;
    sum += (*pixel - grid.PixelOf(i)).squaredNorm();
  }
  found.rms_px = std::sqrt(sum / static_cast<double>(used.size()));
  found.agreeing_ratio = static_cast<double>(used.size()) / static_cast<double>(all);
  if (!(found.rms_px < kMostOff_px)) return std::nullopt;
  return found;
}

}  // namespace foresight
