#include "core/fitting/terrain/surface_kinds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angles.h"
#include "core/geometry/plane.h"

namespace foresight {
namespace {

constexpr double kLevel_rad = RadiansFromDegrees(8.0);
constexpr double kSameGround_m = 0.045;
constexpr double kLeastGround_m2 = 0.05;
constexpr double kNeighbor_m = 0.70;  // between the centres of blocks

Plane PlaneOf(const TerrainSurface& surface) {
  const Eigen::Vector3d normal = surface.base_from_object.Rotate(Eigen::Vector3d::UnitZ());
  return {normal, normal.dot(surface.base_from_object.translation())};
}

bool Level(const Eigen::Vector3d& up, const TerrainSurface& surface) {
  return PlaneOf(surface).normal.dot(up) > std::cos(kLevel_rad);
}

/// Height of a plane above a point.
double HeightAt(const Eigen::Vector3d& up, const Plane& plane, const Eigen::Vector3d& point) {
  return -plane.Distance(point) / plane.normal.dot(up);
}

/// The lowest level surface of some size; -1 = none.
int LowestLevel(const Eigen::Vector3d& up, const std::vector<TerrainSurface>& surfaces) {
  int lowest = -1;
  double height = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const double here = surfaces[i].base_from_object.translation().dot(up);
    if (!Level(up, surfaces[i]) || surfaces[i].size_m.prod() < kLeastGround_m2 || here >= height)
      continue;
    height = here;
    lowest = static_cast<int>(i);
  }
  return lowest;
}

}  // namespace

void TellGround(const Eigen::Vector3d& up, const std::vector<int>& drops,
                std::vector<TerrainSurface>& surfaces) {
  using Kind = TerrainSurface::Kind;
  const int lowest = LowestLevel(up, surfaces);
  if (lowest < 0) return;
  const Plane ground = PlaneOf(surfaces[static_cast<std::size_t>(lowest)]);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    TerrainSurface& surface = surfaces[i];
    if (!Level(up, surface) || (surface.kind == Kind::kBlock && drops[i] >= 2)) continue;
    const double above = -HeightAt(up, ground, surface.base_from_object.translation());
    if (std::abs(above) < kSameGround_m) surface.kind = Kind::kGround;
  }
}

void MeasureSteps(const Eigen::Vector3d& up, std::vector<TerrainSurface>& surfaces) {
  using Kind = TerrainSurface::Kind;
  for (TerrainSurface& surface : surfaces) {
    if (surface.kind != Kind::kBlock) continue;
    const Eigen::Vector3d& center = surface.base_from_object.translation();
    double nearest = kNeighbor_m;
    double lowest = std::numeric_limits<double>::infinity();
    for (const TerrainSurface& other : surfaces) {
      const Eigen::Vector3d& there = other.base_from_object.translation();
      const double distance = (there - center).norm();
      if (&other != &surface && other.kind == Kind::kBlock && distance < nearest) {
        nearest = distance;
        surface.toehold.step_m = (center - there).dot(up);
      }
      if (other.kind != Kind::kGround) continue;
      lowest = std::min(lowest, HeightAt(up, PlaneOf(other), center));
    }
    if (nearest == kNeighbor_m && std::isfinite(lowest)) surface.toehold.step_m = -lowest;
  }
}

}  // namespace foresight
