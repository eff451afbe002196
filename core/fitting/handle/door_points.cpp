#include "core/fitting/handle/door_points.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/base/squared.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/handle/door_things.h"

namespace foresight {
namespace {

constexpr double kNearHandle_m = 0.02;  // rays that pass it so near may end on it
constexpr double kNearDoor_m = 0.06;    // a frame and a plane that is tilted through it
constexpr double kFlatness_m = 0.003;   // no door is a plane
constexpr double kBeside_m = 0.02;      // from the lever to the edge
constexpr double kMostTurn_rad = 0.17;  // of the edge against the lever
constexpr int kTurns = 2;               // to either side
constexpr double kPlaceStep_m = 0.015;  // of the edge
constexpr int kFineRounds = 3;
constexpr std::size_t kLeastSide = 20;   // rays beyond the edge
constexpr double kLeastFraction = 0.08;  // ... of all
constexpr double kLeastStep_m = 0.005, kMostStep_m = 0.060;
constexpr double kStepParameters = 3.0;  // the edge's direction and place, the step
constexpr double kClearly_nats = 5.0;
constexpr int kRounds = 4;

DoorEdge EdgeAt(double turn_rad, double place_m) {
  return {{std::cos(turn_rad), std::sin(turn_rad)}, place_m};
}

}  // namespace

DoorFrame LeverFrame(const Plane& door, const HandleCandidate& handle) {
  const Eigen::Vector3d lever = handle.base_from_object.rotation() * Eigen::Vector3d::UnitX();
  Eigen::Matrix3d axes;
  axes.col(2) = door.normal;
  axes.col(1) = door.normal.cross(lever).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  const Eigen::Vector3d& pivot = handle.base_from_object.translation();
  return {Eigen::Quaterniond(axes), pivot - door.Distance(pivot) * door.normal};
}

double DoorExplanation::Above(const Eigen::Vector3d& at) const {
  const double beyond = edge && edge->Beyond(at) ? 1.0 : 0.0;
  return at.z() - heights.dot(DoorHeights(1.0, at.x(), at.y(), beyond));
}

template <typename Agrees>
DoorHeights DoorPoints::LeastSquares(const std::optional<DoorEdge>& edge,
                                     const Agrees& agrees) const {
  // A ridge for what no point tells: no step without an edge.
  Eigen::Matrix4d normal = 1e-9 * Eigen::Matrix4d::Identity();
  normal.diagonal().segment<2>(1).array() += Squared(sigma_m_ / slope_sigma_rad_) / worth_;
  DoorHeights right = DoorHeights::Zero();
  for (const Eigen::Vector3d& at : points_) {
    if (!agrees(at)) continue;
    const DoorHeights row(1.0, at.x(), at.y(), edge && edge->Beyond(at) ? 1.0 : 0.0);
    normal += row * row.transpose();
    right += at.z() * row;
  }
  return normal.ldlt().solve(right);
}

DoorExplanation DoorPoints::Improved(DoorExplanation start) const {
  for (int round = 0; round < kRounds; ++round) {
    const auto agrees = [&](const Eigen::Vector3d& at) {
      return std::abs(start.Above(at)) < BeamModel::kAgreeSigmas * sigma_m_;
    };
    start.heights = LeastSquares(start.edge, agrees);
  }
  start.cost = CostOf(start);
  return start;
}

std::pair<double, double> DoorPoints::Extent(const Eigen::Vector2d& across) const {
  double low_m = 0.0, high_m = 0.0;
  for (const Eigen::Vector3d& at : points_) {
    low_m = std::min(low_m, across.dot(at.head<2>()));
    high_m = std::max(high_m, across.dot(at.head<2>()));
  }
  return {low_m, high_m};
}

std::size_t DoorPoints::LeastSide() const {
  return std::max(kLeastSide,
                  static_cast<std::size_t>(kLeastFraction * static_cast<double>(points_.size())));
}

double DoorPoints::CostOf(const DoorExplanation& explanation) const {
  double cost = 0.0;
  for (const Eigen::Vector3d& at : points_)
    cost +=
        0.5 * std::min(Squared(BeamModel::kAgreeSigmas), Squared(explanation.Above(at) / sigma_m_));
  return cost;
}

void DoorPoints::Try(const DoorEdge& edge, double length_m, const EdgePlaces& places,
                     DoorExplanation& best) const {
  if (edge.place_m < places.low_m || edge.place_m > places.high_m) return;
  const double tip_m = length_m * edge.across.x();
  if (edge.place_m > std::min(0.0, tip_m) - kBeside_m &&
      edge.place_m < std::max(0.0, tip_m) + kBeside_m)
    return;
  const auto beyond = static_cast<std::size_t>(std::count_if(
      points_.begin(), points_.end(), [&](const Eigen::Vector3d& at) { return edge.Beyond(at); }));
  if (std::min(beyond, points_.size() - beyond) < LeastSide()) return;
  DoorExplanation tried{DoorHeights::Zero(), edge};
  tried.heights = LeastSquares(edge, [](const Eigen::Vector3d&) { return true; });
  tried = Improved(tried);
  const double step_m = std::abs(tried.heights[3]);
  if (step_m >= kLeastStep_m && step_m <= kMostStep_m && tried.cost < best.cost) best = tried;
}

DoorExplanation DoorPoints::WithEdge(const DoorExplanation& flat, double length_m,
                                     const EdgePlaces& places) const {
  DoorExplanation best = flat;
  for (int i = -kTurns; i <= kTurns; ++i) {
    const double turn_rad = i * kMostTurn_rad / kTurns;
    const auto [low_m, high_m] = Extent(EdgeAt(turn_rad, 0.0).across);
    const double first_m = std::max(low_m, places.low_m), last_m = std::min(high_m, places.high_m);
    for (double place_m = first_m + kPlaceStep_m; place_m < last_m; place_m += kPlaceStep_m)
      Try(EdgeAt(turn_rad, place_m), length_m, places, best);
  }
  double turn_step = 0.5 * kMostTurn_rad / kTurns, place_step_m = 0.5 * kPlaceStep_m;
  for (int round = 0; best.edge && round < kFineRounds; ++round) {
    const Eigen::Vector2d across = best.edge->across;
    const double turn_rad = std::atan2(across.y(), across.x()), place_m = best.edge->place_m;
    for (const int turns : {-1, 0, 1})
      for (const int steps : {-1, 0, 1})
        Try(EdgeAt(turn_rad + turns * turn_step, place_m + steps * place_step_m), length_m, places,
            best);
    turn_step *= 0.5;
    place_step_m *= 0.5;
  }
  return best;
}

void DoorPoints::Thin(std::size_t most) {
  const std::size_t step = (points_.size() + most - 1) / most;
  if (step <= 1) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); i += step) points_[kept++] = points_[i];
  points_.resize(kept);
}

double DoorPoints::ForEdge(const DoorExplanation& flat, const DoorExplanation& edged) const {
  if (!edged.edge) return -std::numeric_limits<double>::infinity();
  const double measurements = std::max(1.0, static_cast<double>(points_.size()) * worth_);
  return worth_ * (flat.cost - edged.cost) - 0.5 * kStepParameters * std::log(measurements) -
         kClearly_nats;
}

DoorPoints PointsRound(const RaySet& rays, const Plane& door, const HandleCandidate& handle,
                       const std::function<bool(const Eigen::Vector3d&)>& within) {
  const DoorThing thing = ThingOf(handle.model, handle.base_from_object);
  const auto door_from_base = LeverFrame(door, handle).Inverse();
  const double sigma_m = std::hypot(rays.sigma_m, kFlatness_m);
  std::vector<Eigen::Vector3d> points;
  for (const RangeRay& ray : rays.rays) {
    if (std::abs(door.Distance(ray.Point())) > kNearDoor_m + sigma_m) continue;
    if (thing.Intersect(ray, kNearHandle_m)) continue;
    const Eigen::Vector3d at = door_from_base * ray.Point();
    if (within(at)) points.push_back(at);
  }
  return {std::move(points), sigma_m, rays.samples_per_ray};
}

}  // namespace foresight
