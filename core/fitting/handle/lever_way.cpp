#include "core/fitting/handle/lever_way.h"

#include <cmath>
#include <limits>

#include "core/fitting/handle/door_points.h"

namespace foresight {
namespace {

constexpr double kLeastBackset_m = 0.02, kMostBackset_m = 0.16;  // from a lever's end to the edge
constexpr double kNearer_m = 0.02;  // an edge that counts is so much nearer than the other side's
constexpr double kSeenBeyond_m = 0.40;
constexpr double kOtherEnd_m = 0.03;  // beyond it
constexpr double kAbove_m = 0.12;     // and below; panels begin further from a lever
constexpr std::size_t kLeastPoints = 40, kMostPoints = 1000;
constexpr double kMostSlope = 0.15;  // of what lies round a lever against its door
constexpr double kFound_nats = 4.0;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// How far beyond the lever's tip, else behind its pivot, an edge lies; kNone = none is found.
double DistanceToEdge(const RaySet& around, const Plane& door, const HandleCandidate& lever,
                      bool tip) {
  const double length_m = lever.model.length_m;
  const auto within = [&](const Eigen::Vector3d& at) {
    const double out_m = tip ? at.x() - length_m : -at.x();
    return std::abs(at.y()) < kAbove_m && out_m < kSeenBeyond_m && out_m > -length_m - kOtherEnd_m;
  };
  DoorPoints points = PointsRound(around, door, lever, within);
  if (points.size() < kLeastPoints) return kNone;
  points.Thin(kMostPoints);
  const EdgePlaces places = tip ? EdgePlaces{length_m + kLeastBackset_m, length_m + kMostBackset_m}
                                : EdgePlaces{-kMostBackset_m, -kLeastBackset_m};
  const DoorExplanation flat = points.Improved({});
  const DoorExplanation edged = points.WithEdge(flat, length_m, places);
  if (!(points.ForEdge(flat, edged) >= 0.0)) return kNone;
  if (edged.heights.segment<2>(1).norm() > kMostSlope) return kNone;
  return tip ? edged.edge->place_m - length_m : -edged.edge->place_m;
}

}  // namespace

double EdgesForWay(const RaySet& around, const Plane& door, const HandleCandidate& lever) {
  const double behind_m = DistanceToEdge(around, door, lever, false);
  const double beyond_m = DistanceToEdge(around, door, lever, true);
  if (behind_m + kNearer_m < beyond_m) return kFound_nats;
  if (beyond_m + kNearer_m < behind_m) return -kFound_nats;
  return 0.0;
}

}  // namespace foresight
