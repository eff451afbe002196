#include "core/detection/image_of_region.h"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/fitting/solids/image_edges.h"

namespace foresight {
namespace {

/// How well a frame suits a region, the more the better.
using Rank = std::pair<double, double>;

Rank RankOf(const CameraFrame& frame, const SensorRig& rig, const Roi& roi,
            std::span<const Eigen::Vector3d> points) {
  if (const auto* drawn = std::get_if<ImageRoi>(&roi))
    return {-std::abs(frame.motor_angle_rad - drawn->motor_rad), 0.0};
  const auto camera_from_base = rig.CameraFromBase(frame.motor_angle_rad);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int shown = 0;
  for (const Eigen::Vector3d& point : points) {
    const auto pixel = rig.camera.Project(camera_from_base * point);
    if (!pixel || !rig.camera.InImage(*pixel)) continue;
    sum += *pixel;
    ++shown;
  }
  const Eigen::Vector2d middle(rig.camera.cx, rig.camera.cy);
  return {shown, shown > 0 ? -(sum / shown - middle).norm() : 0.0};
}

}  // namespace

std::shared_ptr<const ImageEdges> ImageOfRegion(const SharedList<CameraFrame>& frames,
                                                const SensorRig& rig, const Roi& roi,
                                                const RaySet& rays, double outline_weight) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(rays.rays.size());
  for (const RangeRay& ray : rays.rays) points.push_back(ray.Point());
  const CameraFrame* best = nullptr;
  Rank best_rank;
  for (const CameraFrame& frame : frames) {
    if (frame.image.width() != rig.camera.width || frame.image.height() != rig.camera.height)
      continue;
    const Rank rank = RankOf(frame, rig, roi, points);
    if (best != nullptr && rank <= best_rank) continue;
    best = &frame;
    best_rank = rank;
  }
  if (best == nullptr) return nullptr;
  auto edges = std::make_shared<const ImageEdges>(
      best->image, ImageView{rig.camera, rig.CameraFromBase(best->motor_angle_rad)}, points,
      outline_weight);
  return edges->Empty() ? nullptr : edges;
}

}  // namespace foresight
