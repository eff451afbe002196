#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/evaluation/door_hardware.h"
#include "core/simulation/ray_caster.h"

namespace foresight {
namespace {

constexpr double kProbeStep_m = 0.003;
constexpr double kLifted_m = 0.022;  // off the door: what a hand can go behind
// What is solid at all of these heights off the door carries what is above: neck and post, and no
// plate that lies on the door, nor an end that is bent back to it.
constexpr std::array kCarriedAt_m = {0.0045, 0.0075, 0.0105, 0.0135, 0.0165, 0.0195};

/// The cells of a grid over the door where a thing is lifted, and which of them are carried.
struct LiftedCells {
  std::vector<Eigen::Vector2d> places;
  std::vector<bool> carried;
  double height_m = 0.0;
};

/// Inside of a solid, whatever other solids overlap it.
bool IsInside(const RayCaster& caster, const Eigen::Vector3d& at) {
  int from_behind = 0;
  for (const Eigen::Vector3f& way : {Eigen::Vector3f(1.0F, 0.0F, 0.0F),
                                     {-1.0F, 0.0F, 0.0F},
                                     {0.0F, 1.0F, 0.0F},
                                     {0.0F, -1.0F, 0.0F}})
    from_behind += caster.Cast({at.cast<float>(), way}).from_behind ? 1 : 0;
  return from_behind > 2;
}

bool IsCarried(const RayCaster& caster, double x, double y) {
  return std::all_of(kCarriedAt_m.begin(), kCarriedAt_m.end(), [&](double z) {
    return IsInside(caster, {x, y, z});
  });
}

LiftedCells CellsOf(const DoorHardware& hardware) {
  constexpr double kFront_m = 1.0;
  auto scene = std::make_shared<Scene>();
  scene->meshes = hardware.parts;
  Eigen::Vector2f low = Eigen::Vector2f::Constant(1e6F), high = -low;
  for (const SceneMesh& part : hardware.parts)
    for (const Eigen::Vector3f& vertex : part.vertices) {
      low = low.cwiseMin(vertex.head<2>());
      high = high.cwiseMax(vertex.head<2>());
    }
  const RayCaster caster(scene);
  LiftedCells cells;
  for (double x = low.x() + 0.5 * kProbeStep_m; x < high.x(); x += kProbeStep_m)
    for (double y = low.y() + 0.5 * kProbeStep_m; y < high.y(); y += kProbeStep_m) {
      const Eigen::Vector3d front(x, y, kFront_m);
      const double top_m =
          kFront_m - caster.Cast({front.cast<float>(), {0.0F, 0.0F, -1.0F}}).distance_m;
      if (!std::isfinite(top_m) || !(top_m > kLifted_m)) continue;
      cells.places.emplace_back(x, y);
      cells.carried.push_back(IsCarried(caster, x, y));
      cells.height_m = std::max(cells.height_m, top_m);
    }
  return cells;
}

}  // namespace

bool DoorThingMeasures::IsLeverHandle() const {
  return height_m >= 0.030 && height_m <= 0.115 && length_m >= 0.085 && length_m <= 0.205 &&
         width_m <= 0.45 * length_m && width_m <= 0.055 && carried_m > 0.0 &&
         free_m >= 0.55 * length_m;
}

DoorThingMeasures MeasureDoorThing(const DoorHardware& hardware) {
  DoorThingMeasures measures;
  const LiftedCells cells = CellsOf(hardware);
  measures.height_m = cells.height_m;
  if (cells.places.size() < 10) return measures;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& place : cells.places) mean += place / static_cast<double>(cells.places.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& place : cells.places) spread += (place - mean) * (place - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
  const Eigen::Vector2d along = eigen.eigenvectors().col(1), across = eigen.eigenvectors().col(0);
  double low = 1e6, high = -1e6, left = 1e6, right = -1e6, first = 1e6, last = -1e6;
  for (std::size_t i = 0; i < cells.places.size(); ++i) {
    const double s = along.dot(cells.places[i] - mean), t = across.dot(cells.places[i] - mean);
    low = std::min(low, s);
    high = std::max(high, s);
    left = std::min(left, t);
    right = std::max(right, t);
    if (!cells.carried[i]) continue;
    first = std::min(first, s);
    last = std::max(last, s);
  }
  measures.length_m = high - low + kProbeStep_m;
  measures.width_m = right - left + kProbeStep_m;
  if (last < first) return measures;  // nothing reaches the door
  // The carried end is the one that the last carried place is nearer to.
  const double from_low = last - low + kProbeStep_m, from_high = high - first + kProbeStep_m;
  measures.carried_m = std::min(from_low, from_high);
  measures.free_m = measures.length_m - measures.carried_m;
  return measures;
}

}  // namespace foresight
