#include "core/fitting/handle/door_surface.h"

#include "core/fitting/handle/door_points.h"

namespace foresight {
namespace {

constexpr std::size_t kLeastRays = 40;
constexpr double kNormalSigma_rad = 0.006;  // of DoorAmongLevels

Plane PlaneOf(const DoorHeights& heights, double step_m, const DoorFrame& base_from_door) {
  const Eigen::Vector3d normal =
      base_from_door.rotation() * Eigen::Vector3d(-heights[1], -heights[2], 1.0).normalized();
  const Eigen::Vector3d on = base_from_door * Eigen::Vector3d(0.0, 0.0, heights[0] + step_m);
  return {normal, normal.dot(on)};
}

}  // namespace

DoorSurface DoorRound(const RaySet& rays, const Plane& rough, bool normal_known,
                      const HandleCandidate& handle) {
  DoorPoints door = PointsRound(rays, rough, handle, [](const Eigen::Vector3d&) { return true; });
  if (normal_known) door.ExpectSlopes(kNormalSigma_rad);
  DoorSurface surface{.door = rough};
  if (door.size() < kLeastRays) return surface;
  const DoorFrame base_from_door = LeverFrame(rough, handle);
  const DoorExplanation flat = door.Improved({});
  surface.door = PlaneOf(flat.heights, 0.0, base_from_door);
  const DoorExplanation edged = door.WithEdge(flat, handle.model.length_m);
  if (!(door.ForEdge(flat, edged) >= 0.0)) return surface;
  const double step_m = edged.heights[3];
  const bool pivot_beyond = edged.edge->Beyond(Eigen::Vector3d::Zero());
  surface.door = PlaneOf(edged.heights, pivot_beyond ? step_m : 0.0, base_from_door);
  surface.beside = PlaneOf(edged.heights, pivot_beyond ? 0.0 : step_m, base_from_door);
  return surface;
}

}  // namespace foresight
