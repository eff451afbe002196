#include "core/fitting/ray_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"
#include "core/registration/recover_grid.h"

namespace foresight {
namespace {

// The filter of Eq. (8) displaces an edge of depth by a few pixels, so the silhouette in a dense
// map is known no better than this.
constexpr double kDenseEdgeBlur_px = 4.0;
// Of a UTM-30LX; docs/simulation.md has the source.
constexpr double kFootprintHeight_rad = 0.012;

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

bool InBoxOrThrough(const BoxRoi& box, BoxRays box_rays, const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& point) {
  return box_rays == BoxRays::kEndInside ? box.Contains(point) : box.Crosses(origin, point);
}

/// A region made ready for many points: an ImageRoi asks where a point appears in its image.
class RegionTest {
 public:
  /// @param rig may be null for a BoxRoi.
  RegionTest(const SensorRig* rig, const Roi& roi, BoxRays box_rays)
      : rig_(rig), roi_(roi), box_rays_(box_rays) {
    const auto* image = std::get_if<ImageRoi>(&roi);
    if (image == nullptr) return;
    camera_from_base_ = rig->CameraFromBase(image->motor_rad);
    bounds_ = image->Bounds();
  }

  bool Holds(const Eigen::Vector3d& origin_in_base, const Eigen::Vector3d& point_in_base) const {
    if (const auto* box = std::get_if<BoxRoi>(&roi_))
      return InBoxOrThrough(*box, box_rays_, origin_in_base, point_in_base);
    const Eigen::Vector3d in_camera = camera_from_base_ * point_in_base;
    if (!(in_camera.z() > 0.0)) return false;
    const auto pixel = rig_->camera.Project(in_camera);
    return pixel && InBox(bounds_, *pixel) && std::get<ImageRoi>(roi_).Contains(*pixel);
  }

 private:
  const SensorRig* rig_;
  const Roi& roi_;
  BoxRays box_rays_;
  Rigid<frame::Camera, frame::Base> camera_from_base_;
  PixelBox bounds_;
};

/// The pixels of a map that can lie in a region.
PixelBox PixelsToLookAt(const Roi& roi, int width, int height) {
  const Eigen::Vector2d last(width - 1, height - 1);
  const auto* image = std::get_if<ImageRoi>(&roi);
  if (image == nullptr) return {Eigen::Vector2d::Zero(), last};
  const PixelBox box = image->Bounds();
  const auto clamped = [&last](const Eigen::Vector2d& corner) -> Eigen::Vector2d {
    return corner.cwiseMax(Eigen::Vector2d::Zero()).cwiseMin(last);
  };
  return {clamped(box.low.array().ceil()), clamped(box.high.array().floor())};
}

Status CheckImage(const Roi& roi, double motor_rad) {
  constexpr double kSameImage_rad = 1e-6;
  const auto* image = std::get_if<ImageRoi>(&roi);
  if (image == nullptr || std::abs(image->motor_rad - motor_rad) <= kSameImage_rad) return {};
  return Fail(ErrorCode::kInvalidInput,
              "the region was drawn on the image at {:.2f} deg, the depth map belongs to the one "
              "at {:.2f} deg",
              DegreesFromRadians(image->motor_rad), DegreesFromRadians(motor_rad));
}

/// Median angle from a ray to its nearest neighbour; NaN where no two rays differ. A few hundred
/// rays spread over the set tell it well enough.
double MedianNeighbourAngle(const std::vector<RangeRay>& rays) {
  constexpr std::size_t kAsked = 400;
  constexpr double kSameDirection = 1e-12;  // of squared chords
  std::vector<double> nearest2;
  const std::size_t step = std::max<std::size_t>(1, rays.size() / kAsked);
  for (std::size_t i = 0; i < rays.size(); i += step) {
    double least = std::numeric_limits<double>::infinity();
    for (const RangeRay& other : rays) {
      const double chord2 = (other.direction - rays[i].direction).squaredNorm();
      if (chord2 > kSameDirection && chord2 < least) least = chord2;
    }
    if (std::isfinite(least)) nearest2.push_back(least);
  }
  if (nearest2.empty()) return std::numeric_limits<double>::quiet_NaN();
  return 2.0 * std::asin(0.5 * std::sqrt(UpperMedian(std::move(nearest2))));
}

}  // namespace

Result<RaySet> RaysFromScan(const RegisteredScan& scan, const SensorRig& rig, const Roi& roi,
                            double sigma_m, BoxRays box_rays) {
  FORESIGHT_CHECK(CheckRoi(roi));
  FORESIGHT_CHECK(CheckSigma(sigma_m));
  RaySet set;
  set.sigma_m = sigma_m;
  set.footprint_rad = rig.lidar.angle_step_rad;
  set.footprint_height_rad = kFootprintHeight_rad;
  const RegionTest region(&rig, roi, box_rays);
  for (int line = 0; line < scan.lines; ++line) {
    const Eigen::Vector3d origin = scan.origins[static_cast<std::size_t>(line)].cast<double>();
    if (!origin.allFinite()) continue;
    for (int beam = 0; beam < scan.beams; ++beam) {
      if (!scan.Valid(line, beam)) continue;
      const Eigen::Vector3d point = scan.points[scan.Index(line, beam)].cast<double>();
      const double range = (point - origin).norm();
      if (range > 0.0 && region.Holds(origin, point))
        set.rays.push_back({origin, (point - origin) / range, range, {beam, line}});
    }
  }
  if (set.rays.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "no lidar return lies inside the region: draw it larger, or scan further");
  set.viewpoint = MeanOrigin(set.rays);
  return set;
}

std::optional<std::pair<int, int>> RowsInRegion(const RegisteredScan& scan, const SensorRig& rig,
                                                const Roi& roi) {
  if (!CheckRoi(roi)) return std::nullopt;
  const RegionTest region(&rig, roi, BoxRays::kEndInside);
  const auto is_seen = [&](int line) {
    const Eigen::Vector3d origin = scan.origins[static_cast<std::size_t>(line)].cast<double>();
    for (int beam = 0; beam < scan.beams; ++beam)
      if (scan.Valid(line, beam) &&
          region.Holds(origin, scan.points[scan.Index(line, beam)].cast<double>()))
        return true;
    return false;
  };
  int first = 0, last = scan.lines - 1;
  while (first <= last && !is_seen(first)) ++first;
  if (first > last) return std::nullopt;
  while (!is_seen(last)) --last;
  return std::pair(first, last);
}

Result<RaySet> RaysFromDepth(const DepthImage& masked_depth_m, const SensorRig& rig,
                             double motor_rad, const Roi& roi, int stride, double sigma_m,
                             double density, BoxRays box_rays) {
  FORESIGHT_CHECK(CheckRoi(roi));
  FORESIGHT_CHECK(CheckImage(roi, motor_rad));
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
      rig.CameraFromBase(motor_rad).Inverse();
  set.viewpoint = base_from_camera.translation();
  const auto* image = std::get_if<ImageRoi>(&roi);
  const auto* box = std::get_if<BoxRoi>(&roi);
  const PixelBox pixels = PixelsToLookAt(roi, masked_depth_m.width(), masked_depth_m.height());
  const Eigen::Vector2i low = pixels.low.cast<int>(), high = pixels.high.cast<int>();
  for (int y = low.y(); y <= high.y(); y += stride) {
    for (int x = low.x(); x <= high.x(); x += stride) {
      const double depth = masked_depth_m(x, y);
      if (!(depth > 0.0) || (image != nullptr && !image->Contains({x, y}))) continue;
      const auto ray = rig.camera.Unproject({x, y});
      if (!ray || !(ray->z() > 0.0)) continue;
      const RangeRay seen{set.viewpoint, base_from_camera.Rotate(*ray), depth / ray->z(),
                          Eigen::Vector2i(x - low.x(), y - low.y()) / stride};
      if (box == nullptr || InBoxOrThrough(*box, box_rays, seen.origin, seen.Point()))
        set.rays.push_back(seen);
    }
  }
  if (set.rays.empty())
    return Fail(ErrorCode::kTooFewPoints,
                "no trusted depth lies inside the region: draw it larger, or lower the confidence "
                "threshold");
  return set;
}

Result<RaySet> RaysFromCloud(std::span<const Eigen::Vector3d> points,
                             const Eigen::Vector3d& viewpoint, const SensorRig* rig, const Roi& roi,
                             double sigma_m, BoxRays box_rays, const GridPlaces* places) {
  FORESIGHT_CHECK(CheckRoi(roi));
  FORESIGHT_CHECK(CheckSigma(sigma_m));
  if (!viewpoint.allFinite())
    return Fail(ErrorCode::kInvalidInput, "rays of a cloud: its viewpoint ({}, {}, {}) is no place",
                viewpoint.x(), viewpoint.y(), viewpoint.z());
  if (rig == nullptr && std::holds_alternative<ImageRoi>(roi))
    return Fail(ErrorCode::kInvalidInput,
                "a region in an image of a cloud needs the calibration of the head");
  RaySet set;
  set.sigma_m = sigma_m;
  set.viewpoint = viewpoint;
  const RegionTest region(rig, roi, box_rays);
  const bool on_grid = places != nullptr && places->kind != GridPlaces::Kind::kScattered;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& point = points[i];
    if (!point.allFinite()) continue;
    const Eigen::Vector3d sight = point - viewpoint;
    const double range = sight.norm();
    if (!(range > 0.0) || !region.Holds(viewpoint, point)) continue;
    const Eigen::Vector2i cell =
        on_grid ? Eigen::Vector2i(places->beam[i], places->line[i]) : Eigen::Vector2i::Constant(-1);
    set.rays.push_back({viewpoint, sight / range, range, cell});
  }
  if (set.rays.empty())
    return Fail(ErrorCode::kTooFewPoints, "no point of the cloud lies inside the region");
  const double neighbour_rad = MedianNeighbourAngle(set.rays);
  if (std::isfinite(neighbour_rad)) set.footprint_rad = neighbour_rad;
  if (on_grid && places->IsOfAFan()) set.footprint_height_rad = kFootprintHeight_rad;
  return set;
}

}  // namespace foresight
