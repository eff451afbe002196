#include "core/detection/residuals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/detection/candidates.h"

namespace foresight {
namespace {

constexpr double kReach_m = 0.100;

/// A ray in the object's frame.
struct LocalRay {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

using Distance = std::function<double(const Eigen::Vector3d&)>;

/// Where a ray first intersects a surface, by sphere tracing within reach of the measured range.
std::optional<double> Trace(const LocalRay& ray, double range_m, const Distance& distance) {
  constexpr double kTouching_m = 5e-4;
  constexpr int kMaxSteps = 100;
  double along = range_m - kReach_m;
  for (int step = 0; step < kMaxSteps && along <= range_m + kReach_m; ++step) {
    const double away = distance(ray.origin + along * ray.direction);
    if (away < kTouching_m) return along;
    along += away;
  }
  return std::nullopt;
}

/// Where a ray intersects a rectangle in the plane z = 0.
std::optional<double> IntersectRectangle(const LocalRay& ray, const Eigen::Vector2d& size_m) {
  if (std::abs(ray.direction.z()) < 1e-6) return std::nullopt;
  const double along = -ray.origin.z() / ray.direction.z();
  const Eigen::Vector2d at = (ray.origin + along * ray.direction).head<2>();
  if ((at.cwiseAbs().array() > 0.5 * size_m.array()).any()) return std::nullopt;
  return along;
}

LocalRay InObject(const RangeRay& ray, const Rigid<frame::Object, frame::Base>& object_from_base) {
  return {object_from_base * ray.origin, object_from_base.Rotate(ray.direction)};
}

void Append(const RangeRay& ray, const std::optional<double>& predicted_m,
            std::vector<Residual>& residuals) {
  if (predicted_m && std::abs(*predicted_m - ray.range_m) <= kReach_m)
    residuals.push_back({ray.Point(), *predicted_m - ray.range_m});
}

std::vector<Residual> OfTemplate(const Rigid<frame::Base, frame::Object>& base_from_object,
                                 const Distance& distance, const RaySet& rays) {
  std::vector<Residual> residuals;
  const auto object_from_base = base_from_object.Inverse();
  for (const RangeRay& ray : rays.rays)
    Append(ray, Trace(InObject(ray, object_from_base), ray.range_m, distance), residuals);
  return residuals;
}

std::vector<Residual> OfTerrain(const TerrainDetection& terrain, const RaySet& rays) {
  std::vector<Residual> residuals;
  for (const RangeRay& ray : rays.rays) {
    std::optional<double> nearest;
    for (const TerrainSurface& surface : terrain.surfaces) {
      const auto met =
          IntersectRectangle(InObject(ray, surface.base_from_object.Inverse()), surface.size_m);
      if (met && (!nearest || std::abs(*met - ray.range_m) < std::abs(*nearest - ray.range_m)))
        nearest = met;
    }
    Append(ray, nearest, residuals);
  }
  return residuals;
}

template <class Found>
const auto& ModelOf(const Found& found, int candidate) {
  const int index = std::clamp(candidate, 0, static_cast<int>(found.alternatives.size()));
  return index == 0 ? found.best.model
                    : found.alternatives[static_cast<std::size_t>(index - 1)].model;
}

}  // namespace

std::vector<Residual> ResidualsOf(const Detection& detection, int candidate, const RaySet& rays) {
  if (const auto* terrain = std::get_if<TerrainDetection>(&detection))
    return OfTerrain(*terrain, rays);
  const auto pose = CandidatePose(detection, candidate);
  if (const auto* valve = std::get_if<ValveDetection>(&detection)) {
    const ValveModel& model = ModelOf(*valve, candidate);
    return OfTemplate(
        pose, [&](const Eigen::Vector3d& p) { return model.Distance(p); }, rays);
  }
  if (const auto* handle = std::get_if<HandleDetection>(&detection)) {
    const HandleModel& model = ModelOf(*handle, candidate);
    return OfTemplate(
        pose, [&](const Eigen::Vector3d& p) { return model.Distance(p); }, rays);
  }
  if (const auto* cylinder = std::get_if<CylinderDetection>(&detection)) {
    const SolidPart part = PartOf(cylinder->model);
    return OfTemplate(
        pose, [&](const Eigen::Vector3d& p) { return part.Distance(p); }, rays);
  }
  const DrillModel& model = ModelOf(std::get<DrillDetection>(detection), candidate);
  return OfTemplate(
      pose, [&](const Eigen::Vector3d& p) { return model.Distance(p); }, rays);
}

}  // namespace foresight
