#include "core/fitting/handle/door_surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/squared.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/handle/door_things.h"
#include "core/fitting/handle/handle_state.h"

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
constexpr std::size_t kLeastRays = 40;
constexpr int kRounds = 4;

/// Height over the door: a + b x + c y, and d more beyond an edge.
using Heights = Eigen::Vector4d;

struct Edge {
  Eigen::Vector2d across = Eigen::Vector2d::UnitX();
  double place_m = 0.0;

  bool Beyond(const Eigen::Vector3d& at) const { return across.dot(at.head<2>()) > place_m; }
};

/// One way to explain the points, which are in the rough door's frame.
struct Explanation {
  Heights heights = Heights::Zero();
  std::optional<Edge> edge;
  double cost = 0.0;  ///< half the sum of squared deviations, each at most kAgreeSigmas

  double Above(const Eigen::Vector3d& at) const {
    const double beyond = edge && edge->Beyond(at) ? 1.0 : 0.0;
    return at.z() - heights.dot(Heights(1.0, at.x(), at.y(), beyond));
  }
};

class DoorPoints {
 public:
  DoorPoints(std::vector<Eigen::Vector3d> points, double sigma_m)
      : points_(std::move(points)), sigma_m_(sigma_m) {}

  /// Least squares over the points that agree with the start, again and again.
  Explanation Improved(Explanation start) const {
    for (int round = 0; round < kRounds; ++round) {
      const auto agrees = [&](const Eigen::Vector3d& at) {
        return std::abs(start.Above(at)) < BeamModel::kAgreeSigmas * sigma_m_;
      };
      start.heights = LeastSquares(start.edge, agrees);
    }
    start.cost = CostOf(start);
    return start;
  }

  /// The best edge across the lever, which lies along x from 0 to `length_m`, and beside it;
  /// without one where none has enough points to either side.
  Explanation WithEdge(const Explanation& flat, double length_m) const {
    Explanation best = flat;
    for (int i = -kTurns; i <= kTurns; ++i) {
      const double turn_rad = i * kMostTurn_rad / kTurns;
      const auto [low_m, high_m] = Extent(EdgeAt(turn_rad, 0.0).across);
      for (double place_m = low_m + kPlaceStep_m; place_m < high_m; place_m += kPlaceStep_m)
        Try(EdgeAt(turn_rad, place_m), length_m, best);
    }
    double turn_step = 0.5 * kMostTurn_rad / kTurns, place_step_m = 0.5 * kPlaceStep_m;
    for (int round = 0; best.edge && round < kFineRounds; ++round) {
      const Eigen::Vector2d across = best.edge->across;
      const double turn_rad = std::atan2(across.y(), across.x()), place_m = best.edge->place_m;
      for (const int turns : {-1, 0, 1})
        for (const int places : {-1, 0, 1})
          Try(EdgeAt(turn_rad + turns * turn_step, place_m + places * place_step_m), length_m,
              best);
      turn_step *= 0.5;
      place_step_m *= 0.5;
    }
    return best;
  }

 private:
  static Edge EdgeAt(double turn_rad, double place_m) {
    return {{std::cos(turn_rad), std::sin(turn_rad)}, place_m};
  }

  /// Least and largest place across.
  std::pair<double, double> Extent(const Eigen::Vector2d& across) const {
    double low_m = 0.0, high_m = 0.0;
    for (const Eigen::Vector3d& at : points_) {
      low_m = std::min(low_m, across.dot(at.head<2>()));
      high_m = std::max(high_m, across.dot(at.head<2>()));
    }
    return {low_m, high_m};
  }

  /// Takes the edge where it explains the points better.
  void Try(const Edge& edge, double length_m, Explanation& best) const {
    const double tip_m = length_m * edge.across.x();
    if (edge.place_m > std::min(0.0, tip_m) - kBeside_m &&
        edge.place_m < std::max(0.0, tip_m) + kBeside_m)
      return;
    const auto beyond = static_cast<std::size_t>(
        std::count_if(points_.begin(), points_.end(),
                      [&](const Eigen::Vector3d& at) { return edge.Beyond(at); }));
    if (std::min(beyond, points_.size() - beyond) < LeastSide()) return;
    Explanation tried{Heights::Zero(), edge};
    tried.heights = LeastSquares(edge, [](const Eigen::Vector3d&) { return true; });
    tried = Improved(tried);
    const double step_m = std::abs(tried.heights[3]);
    if (step_m >= kLeastStep_m && step_m <= kMostStep_m && tried.cost < best.cost) best = tried;
  }

  std::size_t LeastSide() const {
    return std::max(kLeastSide,
                    static_cast<std::size_t>(kLeastFraction * static_cast<double>(points_.size())));
  }

  template <typename Agrees>
  Heights LeastSquares(const std::optional<Edge>& edge, const Agrees& agrees) const {
    // A ridge for what no point tells: no step without an edge.
    Eigen::Matrix4d normal = 1e-9 * Eigen::Matrix4d::Identity();
    Heights right = Heights::Zero();
    for (const Eigen::Vector3d& at : points_) {
      if (!agrees(at)) continue;
      const Heights row(1.0, at.x(), at.y(), edge && edge->Beyond(at) ? 1.0 : 0.0);
      normal += row * row.transpose();
      right += at.z() * row;
    }
    return normal.ldlt().solve(right);
  }

  double CostOf(const Explanation& explanation) const {
    double cost = 0.0;
    for (const Eigen::Vector3d& at : points_)
      cost += 0.5 *
              std::min(Squared(BeamModel::kAgreeSigmas), Squared(explanation.Above(at) / sigma_m_));
    return cost;
  }

  std::vector<Eigen::Vector3d> points_;
  double sigma_m_;
};

/// On the door under the pivot: z = the door's normal, x along the lever.
DoorFrame LeverFrame(const Plane& door, const HandleCandidate& handle) {
  const Eigen::Vector3d lever = handle.base_from_object.rotation() * Eigen::Vector3d::UnitX();
  Eigen::Matrix3d axes;
  axes.col(2) = door.normal;
  axes.col(1) = door.normal.cross(lever).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  const Eigen::Vector3d& pivot = handle.base_from_object.translation();
  return {Eigen::Quaterniond(axes), pivot - door.Distance(pivot) * door.normal};
}

Plane PlaneOf(const Heights& heights, double step_m, const DoorFrame& base_from_door) {
  const Eigen::Vector3d normal =
      base_from_door.rotation() * Eigen::Vector3d(-heights[1], -heights[2], 1.0).normalized();
  const Eigen::Vector3d on = base_from_door * Eigen::Vector3d(0.0, 0.0, heights[0] + step_m);
  return {normal, normal.dot(on)};
}

}  // namespace

DoorSurface DoorRound(const RaySet& rays, const Plane& rough, const HandleCandidate& handle) {
  const DoorThing thing = ThingOf(handle.model, handle.base_from_object);
  const DoorFrame base_from_door = LeverFrame(rough, handle);
  const auto door_from_base = base_from_door.Inverse();
  const double sigma_m = std::hypot(rays.sigma_m, kFlatness_m);
  std::vector<Eigen::Vector3d> points;
  for (const RangeRay& ray : rays.rays) {
    if (std::abs(rough.Distance(ray.Point())) > kNearDoor_m + sigma_m) continue;
    if (thing.Intersect(ray, kNearHandle_m)) continue;
    points.push_back(door_from_base * ray.Point());
  }
  DoorSurface surface{.door = rough};
  if (points.size() < kLeastRays) return surface;
  const double measurements = static_cast<double>(points.size()) * rays.samples_per_ray;
  const DoorPoints door(std::move(points), sigma_m);
  const Explanation flat = door.Improved({});
  surface.door = PlaneOf(flat.heights, 0.0, base_from_door);
  const Explanation edged = door.WithEdge(flat, handle.model.length_m);
  const double gain = rays.samples_per_ray * (flat.cost - edged.cost);
  if (!edged.edge || gain < 0.5 * kStepParameters * std::log(measurements) + kClearly_nats)
    return surface;
  const double step_m = edged.heights[3];
  const bool pivot_beyond = edged.edge->Beyond(Eigen::Vector3d::Zero());
  surface.door = PlaneOf(edged.heights, pivot_beyond ? step_m : 0.0, base_from_door);
  surface.beside = PlaneOf(edged.heights, pivot_beyond ? 0.0 : step_m, base_from_door);
  return surface;
}

}  // namespace foresight
