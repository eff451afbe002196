#pragma once

#include <Eigen/Core>
#include <array>

#include "core/fitting/handle/door_things.h"
#include "core/fitting/handle/fit_handle.h"

namespace foresight {

/// What a fit may change of a handle; all but the door's plane.
enum HandleParameter {
  kHandleX,  ///< of the pivot, in the door's frame
  kHandleY,
  kHandleTurn,  ///< of the lever about the door's normal
  kHandleStandoff,
  kHandleLength,
  kHandleBehind,
  kHandleBow,
  kHandleLift,
  kHandleRadius,
  kHandleParameters
};
/// Without the bow and the lift, which hardly leave what is built.
constexpr int kFreeHandleParameters = kHandleParameters - 2;
using HandleStep = Eigen::Matrix<double, kHandleParameters, 1>;
using HandleInformation = Eigen::Matrix<double, kHandleParameters, kHandleParameters>;

/// A door's frame: z = its normal towards the viewer, the origin on it.
using DoorFrame = Rigid<frame::Base, frame::Object>;
DoorFrame DoorFrameOf(const Plane& door, const Eigen::Vector3d& near_point);

/// A handle on a door while it is looked for.
struct HandleState {
  HandleStep values = HandleStep::Zero();
  bool returned = false;
  HandleModel::Plate plate = HandleModel::Plate::kRosette;
  double score = 0.0;  ///< log likelihood with the prior

  HandleModel Model() const;
  Rigid<frame::Base, frame::Object> Pose(const DoorFrame& base_from_door) const;
};

/// How door handles are built.
struct HandlePrior {
  static constexpr double kStandoff_m = 0.052;
  static constexpr double kStandoffSigma_m = 0.012;
  static constexpr double kRadius_m = 0.010;
  static constexpr double kRadiusSigma_m = 0.0025;
  static constexpr double kLength_m = 0.120;
  static constexpr double kLengthSigma_m = 0.025;
  static constexpr double kBehind_m = 0.012;       ///< mean of an exponential
  static constexpr double kBehindSigma_m = 0.006;  ///< most levers end at their pivot
  static constexpr double kBowSigma_m = 0.006, kLiftSigma_m = 0.005;
  static constexpr double kMostBow_m = 0.025;
  static constexpr double kMostBehind = 0.8;  ///< of the length; beyond, it is a bar on a post
};

/// What a handle is scored against.
struct HandleScorer {
  const BeamLikelihood& likelihood;
  const DoorFrame& base_from_door;
  const FitHandleOptions& options;

  /// With the prior; minus infinity outside of what is built.
  double operator()(const HandleState& state) const;
};

/// The same handle, as nearly as may be, on another door.
HandleState OnDoor(const HandleState& state, const DoorFrame& base_from_door,
                   const DoorFrame& base_from_other);

/// The lever that covers the same place and points the other way.
HandleState Mirrored(const HandleState& state);
/// The lever that covers the same place and has its pivot `by_m` further along.
HandleState WithPivotAlong(const HandleState& state, double by_m);

/// By how much a handle moves on its door while it comes off it by a metre, along the line on which
/// it is seen: it looks the same from there. Bounded for a door that is seen from its side.
/// @param viewpoint in the door's frame
Eigen::Vector2d AlongSight(const HandleState& state, const Eigen::Vector3d& viewpoint);

/// The same with either end and on either plate.
std::array<HandleState, 4> VariantsOf(const HandleState& state);

HandleCandidate CandidateOf(const HandleState& state, const DoorFrame& base_from_door);

}  // namespace foresight
