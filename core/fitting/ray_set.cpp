#include "core/fitting/ray_set.h"

#include <algorithm>
#include <cmath>

namespace foresight {
namespace {

// The filter of Eq. (8) displaces an edge of depth by a few pixels, so the silhouette in a dense
// map is known no better than this.
constexpr double kDenseEdgeBlur_px = 4.0;

bool InBox(const PixelBox& box, const Eigen::Vector2d& pixel) {
  return (pixel.array() >= box.low.array()).all() && (pixel.array() <= box.high.array()).all();
}

Status CheckSigma(double sigma_m) {
  if (std::isfinite(sigma_m) && sigma_m > 0.0) return {};
  return Fail(ErrorCode::kInvalidOptions, "rays of a region: sigma_m {} is not above 0", sigma_m);
}

Eigen::Vector3d MeanOrigin(const std::vector<RangeRay>& rays) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : rays) sum += ray.origin;
  return sum / static_cast<double>(rays.size());
}

}  // namespace

Result<RaySet> RaysFromScan(const RegisteredScan& scan, const SensorRig& rig, const ImageRoi& roi,
                            double sigma_m) {
  FORESIGHT_CHECK(roi.Check());
  FORESIGHT_CHECK(CheckSigma(sigma_m));
  RaySet set;
  set.sigma_m = sigma_m;
  set.footprint_rad = rig.lidar.angle_step_rad;
  const Rigid<frame::Camera, frame::Base> camera_from_base = rig.CameraFromBase(roi.motor_rad);
  const PixelBox box = roi.Bounds();
  for (int line = 0; line < scan.lines; ++line) {
    const Eigen::Vector3d origin = scan.origins[static_cast<std::size_t>(line)].cast<double>();
    if (!origin.allFinite()) continue;
    for (int beam = 0; beam < scan.beams; ++beam) {
      if (!scan.Valid(line, beam)) continue;
      const Eigen::Vector3d point = scan.points[scan.Index(line, beam)].cast<double>();
      const Eigen::Vector3d in_camera = camera_from_base * point;
      if (!(in_camera.z() > 0.0)) continue;
      const auto pixel = rig.camera.Project(in_camera);
      if (!pixel || !InBox(box, *pixel) || !roi.Contains(*pixel)) continue;
      const double range = (point - origin).norm();
      if (range > 0.0) set.rays.push_back({origin, (point - origin) / range, range});
    }
  }
  if (set.rays.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "no lidar return lies inside the region: draw it larger, or scan further");
  set.viewpoint = MeanOrigin(set.rays);
  return set;
}

Result<RaySet> RaysFromDepth(const DepthImage& masked_depth_m, const SensorRig& rig,
                             const ImageRoi& roi, int stride, double sigma_m, double density) {
  FORESIGHT_CHECK(roi.Check());
  FORESIGHT_CHECK(CheckSigma(sigma_m));
  if (stride < 1)
    return Fail(ErrorCode::kInvalidOptions, "rays of a region: stride {} is below 1", stride);
  if (!(density > 0.0))
    return Fail(ErrorCode::kInvalidOptions, "rays of a region: density {} is not above 0", density);
  if (masked_depth_m.width() != rig.camera.width || masked_depth_m.height() != rig.camera.height)
    return Fail(ErrorCode::kInvalidInput, "depth map is {} x {}, but the rig's camera {} x {}",
                masked_depth_m.width(), masked_depth_m.height(), rig.camera.width,
                rig.camera.height);
  RaySet set;
  set.sigma_m = sigma_m;
  set.dense = true;
  set.samples_per_ray = std::min(1.0, density * stride * stride);
  set.footprint_rad = std::max<double>(stride, kDenseEdgeBlur_px) / rig.camera.fx;
  const Rigid<frame::Base, frame::Camera> base_from_camera =
      rig.CameraFromBase(roi.motor_rad).Inverse();
  set.viewpoint = base_from_camera.translation();
  const PixelBox box = roi.Bounds();
  const auto clamped = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, size - 1.0));
  };
  const int x_end = clamped(std::floor(box.high.x()), masked_depth_m.width());
  const int y_end = clamped(std::floor(box.high.y()), masked_depth_m.height());
  for (int y = clamped(std::ceil(box.low.y()), masked_depth_m.height()); y <= y_end; y += stride) {
    for (int x = clamped(std::ceil(box.low.x()), masked_depth_m.width()); x <= x_end; x += stride) {
      const double depth = masked_depth_m(x, y);
      if (!(depth > 0.0) || !roi.Contains({x, y})) continue;
      const auto ray = rig.camera.Unproject({x, y});
      if (!ray || !(ray->z() > 0.0)) continue;
      set.rays.push_back({set.viewpoint, base_from_camera.Rotate(*ray), depth / ray->z()});
    }
  }
  if (set.rays.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "no trusted depth lies inside the region: draw it larger, or lower the confidence "
                "threshold");
  return set;
}

}  // namespace foresight
