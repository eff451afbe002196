#include "core/calibration/camera_of_grid.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/nearest_rotation.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

/// The projection up to its scale: rows of (u, v, 1) ~ M p, pixels from the middle in widths.
Eigen::Matrix3d Projection(std::span<const Eigen::Vector3d> points, int width, double middle_u,
                           double middle_v, double scale) {
  Matrix9 sum = Matrix9::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || points[i].isZero()) continue;
    const Eigen::Vector3d ray = points[i].normalized();
    const double u = (static_cast<double>(i % static_cast<std::size_t>(width)) - middle_u) / scale;
    const double v = (static_cast<double>(i / static_cast<std::size_t>(width)) - middle_v) / scale;
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

}  // namespace

std::optional<GridCamera> CameraOfGrid(std::span<const Eigen::Vector3d> points, int width) {
  constexpr std::size_t kLeastPoints = 100;
  constexpr double kMostOff_px = 0.7;  ///< rms; a quantised pixel alone is 0.4
  const auto count = static_cast<std::size_t>(std::count_if(
      points.begin(), points.end(),
      [](const Eigen::Vector3d& point) { return point.allFinite() && !point.isZero(); }));
  if (width < 2 || count < kLeastPoints) return std::nullopt;
  const auto height = static_cast<int>(points.size() / static_cast<std::size_t>(width));
  if (height < 2) return std::nullopt;
  const double middle_u = 0.5 * (width - 1), middle_v = 0.5 * (height - 1), scale = 0.5 * width;
  Eigen::Matrix3d m = Projection(points, width, middle_u, middle_v, scale);
  double ahead = 0.0;
  for (const Eigen::Vector3d& point : points)
    if (point.allFinite()) ahead += m.row(2).dot(point) > 0.0 ? 1.0 : -1.0;
  m *= (ahead < 0.0 ? -1.0 : 1.0) / m.row(2).norm();
  const Eigen::Vector3d z = m.row(2).transpose();
  const double cx = m.row(0).dot(z), cy = m.row(1).dot(z);
  const Eigen::Vector3d x = m.row(0).transpose() - cx * z, y = m.row(1).transpose() - cy * z;
  if (!(x.norm() > 1e-3 && y.norm() > 1e-3)) return std::nullopt;
  Eigen::Matrix3d axes;
  axes << x.normalized().transpose(), y.normalized().transpose(), z.transpose();
  if (!(axes.determinant() > 0.5)) return std::nullopt;  // mirrored, or no camera's
  GridCamera found;
  found.camera = PinholeCamera(width, height, 1.0, scale * cx + middle_u, scale * cy + middle_v);
  found.camera.fx = scale * x.norm();
  found.camera.fy = scale * y.norm();
  found.camera_from_cloud =
      Rigid<frame::Camera, frame::Robot>(NearestRotation(axes), Eigen::Vector3d::Zero());
  if (!found.camera.Check()) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || points[i].isZero()) continue;
    const auto pixel = found.camera.Project(found.camera_from_cloud * points[i]);
    if (!pixel) return std::nullopt;
    const Eigen::Vector2d own(static_cast<double>(i % static_cast<std::size_t>(width)),
                              static_cast<double>(i / static_cast<std::size_t>(width)));
    sum += (*pixel - own).squaredNorm();
  }
  found.rms_px = std::sqrt(sum / static_cast<double>(count));
  if (!(found.rms_px < kMostOff_px)) return std::nullopt;
  return found;
}

}  // namespace foresight
