#include "core/fitting/handle/handle_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/squared.h"
#include "core/geometry/rotation_between.h"

namespace foresight {
namespace {

constexpr double kLeastStandoff_m = 0.025, kLargestStandoff_m = 0.100;
constexpr double kLeastRadius_m = 0.005, kLargestRadius_m = 0.018;

}  // namespace

DoorFrame DoorFrameOf(const Plane& door, const Eigen::Vector3d& near_point) {
  return {RotationBetween(Eigen::Vector3d::UnitZ(), door.normal),
          near_point - door.Distance(near_point) * door.normal};
}

HandleModel HandleState::Model() const {
  HandleModel model;
  model.length_m = values[kHandleLength];
  model.behind_m = values[kHandleBehind];
  model.bow_m = values[kHandleBow];
  model.lift_m = values[kHandleLift];
  model.radius_m = values[kHandleRadius];
  model.standoff_m = values[kHandleStandoff];
  model.returned = returned;
  model.plate = plate;
  return model;
}

Rigid<frame::Base, frame::Object> HandleState::Pose(const DoorFrame& base_from_door) const {
  const Rigid<frame::Object, frame::Object> door_from_handle(
      Eigen::Quaterniond(Eigen::AngleAxisd(values[kHandleTurn], Eigen::Vector3d::UnitZ())),
      {values[kHandleX], values[kHandleY], values[kHandleStandoff]});
  return base_from_door * door_from_handle;
}

double HandleScorer::operator()(const HandleState& state) const {
  const HandleStep& v = state.values;
  const bool built =
      v[kHandleLength] >= options.min_length_m && v[kHandleLength] <= options.max_length_m &&
      v[kHandleBehind] >= 0.0 && v[kHandleBehind] <= HandlePrior::kMostBehind * v[kHandleLength] &&
      std::abs(v[kHandleBow]) <= HandlePrior::kMostBow_m &&
      std::abs(v[kHandleLift]) <= HandlePrior::kMostBow_m &&
      v[kHandleStandoff] >= kLeastStandoff_m && v[kHandleStandoff] <= kLargestStandoff_m &&
      v[kHandleRadius] >= kLeastRadius_m && v[kHandleRadius] <= kLargestRadius_m;
  if (!built) return -std::numeric_limits<double>::infinity();
  using Prior = HandlePrior;
  const double prior =
      -0.5 * (Squared((v[kHandleStandoff] - Prior::kStandoff_m) / Prior::kStandoffSigma_m) +
              Squared((v[kHandleRadius] - Prior::kRadius_m) / Prior::kRadiusSigma_m) +
              Squared((v[kHandleLength] - Prior::kLength_m) / Prior::kLengthSigma_m) +
              Squared(v[kHandleBow] / Prior::kBowSigma_m) +
              Squared(v[kHandleLift] / Prior::kLiftSigma_m)) -
      v[kHandleBehind] / Prior::kBehind_m;
  return prior + LogLikelihoodOf(ThingOf(state.Model(), state.Pose(base_from_door)), likelihood);
}

HandleState OnDoor(const HandleState& state, const DoorFrame& base_from_door,
                   const DoorFrame& base_from_other) {
  const auto other_from_handle = base_from_other.Inverse() * state.Pose(base_from_door);
  const Eigen::Vector3d along = other_from_handle.rotation() * Eigen::Vector3d::UnitX();
  HandleState moved = state;
  moved.values[kHandleX] = other_from_handle.translation().x();
  moved.values[kHandleY] = other_from_handle.translation().y();
  moved.values[kHandleStandoff] = other_from_handle.translation().z();
  moved.values[kHandleTurn] = std::atan2(along.y(), along.x());
  return moved;
}

HandleState Mirrored(const HandleState& state) {
  HandleState mirrored = state;
  const double turn = state.values[kHandleTurn];
  const double pivot_m = state.values[kHandleLength] - state.values[kHandleBehind];
  mirrored.values[kHandleX] += pivot_m * std::cos(turn);
  mirrored.values[kHandleY] += pivot_m * std::sin(turn);
  mirrored.values[kHandleBow] = -state.values[kHandleBow];
  mirrored.values[kHandleTurn] = std::remainder(turn + std::numbers::pi, 2.0 * std::numbers::pi);
  return mirrored;
}

HandleState WithPivotAlong(const HandleState& state, double by_m) {
  HandleState moved = state;
  HandleStep& v = moved.values;
  const double turn = v[kHandleTurn];
  // The parabola's place there, and what of it is left: its sagitta goes with the square of that.
  const double s = std::clamp(by_m / v[kHandleLength], 0.0, 1.0), off = HandleModel::BowAt(s);
  const double beside_m = off * v[kHandleBow];
  v[kHandleX] += by_m * std::cos(turn) - beside_m * std::sin(turn);
  v[kHandleY] += by_m * std::sin(turn) + beside_m * std::cos(turn);
  v[kHandleStandoff] += off * v[kHandleLift];
  v[kHandleLength] -= by_m;
  v[kHandleBehind] += by_m;
  v[kHandleTurn] += std::atan2(-beside_m, v[kHandleLength]);
  v[kHandleBow] *= Squared(1.0 - s);
  v[kHandleLift] *= Squared(1.0 - s);
  return moved;
}

Eigen::Vector2d AlongSight(const HandleState& state, const Eigen::Vector3d& viewpoint) {
  constexpr double kLeastOff = 0.3;  // of the line of sight, off the door: seen from its side
  const HandleStep& v = state.values;
  const Eigen::Vector3d sight =
      viewpoint - Eigen::Vector3d(v[kHandleX], v[kHandleY], v[kHandleStandoff]);
  return sight.head<2>() / std::max(sight.z(), kLeastOff * sight.norm());
}

std::array<HandleState, 4> VariantsOf(const HandleState& state) {
  std::array<HandleState, 4> variants;
  std::size_t i = 0;
  for (const bool returned : {false, true})
    for (const auto plate : {HandleModel::Plate::kRosette, HandleModel::Plate::kLong}) {
      variants[i] = state;
      variants[i].returned = returned;
      variants[i++].plate = plate;
    }
  return variants;
}

HandleCandidate CandidateOf(const HandleState& state, const DoorFrame& base_from_door) {
  return {state.Pose(base_from_door), state.Model(), state.score};
}

}  // namespace foresight
