#include "core/fitting/terrain/terrain_shift.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kMaxTilt_rad = RadiansFromDegrees(30.0);
constexpr double kSquare = 0.9;  // shorter to longer side

bool IsBlock(const TerrainSurface& surface) {
  return surface.kind == TerrainSurface::Kind::kBlock;
}

double Distance(const TerrainSurface& a, const TerrainSurface& b) {
  return (a.base_from_object.translation() - b.base_from_object.translation()).norm();
}

double AngleBetweenNormals(const TerrainSurface& a, const TerrainSurface& b) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  return std::acos(
      std::clamp(a.base_from_object.Rotate(up).dot(b.base_from_object.Rotate(up)), -1.0, 1.0));
}

}  // namespace

double TurnBetween(const TerrainSurface& a, const TerrainSurface& b) {
  const bool square = a.size_m.minCoeff() > kSquare * a.size_m.maxCoeff();
  const int turns = square ? 4 : 2;
  double least = std::numbers::pi;
  for (int i = 0; i < turns; ++i) {
    const Eigen::Quaterniond symmetry(
        Eigen::AngleAxisd(2.0 * std::numbers::pi * i / turns, Eigen::Vector3d::UnitZ()));
    least = std::min(least, a.base_from_object.rotation().angularDistance(
                                b.base_from_object.rotation() * symmetry));
  }
  return least;
}

void MarkShifts(const TerrainDetection& last, std::vector<TerrainSurface>& surfaces) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t j = 0; j < last.surfaces.size(); ++j) {
      const TerrainSurface &now = surfaces[i], &before = last.surfaces[j];
      if (!IsBlock(now) || !IsBlock(before)) continue;
      const double distance = Distance(now, before);
      if (distance < 0.5 * now.size_m.minCoeff() && AngleBetweenNormals(now, before) < kMaxTilt_rad)
        pairs.emplace_back(distance, i, j);
    }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> taken(last.surfaces.size(), false);
  for (const auto& [distance, i, j] : pairs) {
    if (taken[j] || std::isfinite(surfaces[i].shift_m)) continue;
    taken[j] = true;
    surfaces[i].shift_m = distance;
    surfaces[i].turn_rad = TurnBetween(surfaces[i], last.surfaces[j]);
  }
}

}  // namespace foresight
