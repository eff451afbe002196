#include "core/fitting/handle/handle_state.h"

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
      v[kHandleStandoff] >= kLeastStandoff_m && v[kHandleStandoff] <= kLargestStandoff_m &&
      v[kHandleRadius] >= kLeastRadius_m && v[kHandleRadius] <= kLargestRadius_m;
  if (!built) return -std::numeric_limits<double>::infinity();
  using Prior = HandlePrior;
  const double prior =
      -0.5 * (Squared((v[kHandleStandoff] - Prior::kStandoff_m) / Prior::kStandoffSigma_m) +
              Squared((v[kHandleRadius] - Prior::kRadius_m) / Prior::kRadiusSigma_m) +
              Squared((v[kHandleLength] - Prior::kLength_m) / Prior::kLengthSigma_m)) -
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
  mirrored.values[kHandleTurn] = std::remainder(turn + std::numbers::pi, 2.0 * std::numbers::pi);
  return mirrored;
}

HandleState WithPivotAlong(const HandleState& state, double by_m) {
  HandleState moved = state;
  const double turn = state.values[kHandleTurn];
  moved.values[kHandleX] += by_m * std::cos(turn);
  moved.values[kHandleY] += by_m * std::sin(turn);
  moved.values[kHandleLength] -= by_m;
  moved.values[kHandleBehind] += by_m;
  return moved;
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
