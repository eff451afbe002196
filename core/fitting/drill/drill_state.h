#pragma once

#include <Eigen/Core>
#include <array>

#include "core/fitting/beam_footprints.h"
#include "core/fitting/drill/drill_detection.h"
#include "core/geometry/angles.h"
#include "core/geometry/plane.h"
#include "core/objects/drill_template.h"

namespace foresight {

/// What a fit may change of a drill.
enum DrillParameter {
  kDrillX,  ///< of the origin on the table, in the table's frame
  kDrillY,
  kDrillZ,  ///< above the table: a fitted plane is a few millimetres off
  kDrillYaw,
  kDrillScale,
  kDrillTiltX,  ///< the body's own lean
  kDrillTiltY,
  kDrillBit,
  kDrillHeadUp,  ///< DrillProportions: drills of one kind are not alike
  kDrillFront,
  kDrillBack,
  kDrillNose,         ///< fraction - 1
  kDrillChuck,        ///< fraction - 1
  kDrillChuckLonger,  ///< metres
  kDrillFoot,         ///< size of the foot to that of the template - 1
  kDrillFootForward,
  kDrillRake,
  kDrillFootHeight,  ///< fraction - 1
  kDrillGrip,        ///< fraction - 1
  kDrillHead,        ///< fraction - 1
  kDrillParameters
};
/// How many come first: place, way, size, lean and bit, which no template knows. The others are
/// DrillProportions.
constexpr int kDrillFreeParameters = kDrillHeadUp;
using DrillStep = Eigen::Matrix<double, kDrillParameters, 1>;
using DrillInformation = Eigen::Matrix<double, kDrillParameters, kDrillParameters>;

/// How beams before a drill are looked at: no real one is made of cylinders and boxes.
inline constexpr BeamOptions kDrillBeams;

/// Where drills may stand: a table's frame, z = its normal.
using TableFrame = Rigid<frame::Base, frame::Object>;
TableFrame FrameOf(const Plane& table, const Eigen::Vector3d& near_point);

/// A template at a place of a table.
struct DrillState {
  const DrillTemplate* kind = nullptr;
  DrillStep values = DrillStep::Zero();
  double log_likelihood = 0.0;  ///< with the prior

  double yaw() const { return values[kDrillYaw]; }
  DrillModel Model() const;
  Rigid<frame::Base, frame::Object> Pose(const TableFrame& base_from_table) const;
};

/// How sure it is, before any ray, where a table's foot stands, that a drill stands upright, and
/// that it is built as the template says.
struct DrillPrior {
  double height_sigma_m = 0.005;
  double max_tilt_rad = RadiansFromDegrees(15.0);
  double scale_sigma = 0.08;
  double tilt_sigma_rad = 0.07;    ///< 4 deg
  double head_up_sigma_m = 0.012;  ///< against the template's
  double front_sigma_m = 0.010;
  double back_sigma_m = 0.014;
  double nose_sigma = 0.15;   ///< fraction of its radius
  double chuck_sigma = 0.15;  ///< fraction of its radius
  double chuck_longer_sigma_m = 0.010;
  double foot_sigma = 0.12;         ///< fraction of its size
  double foot_height_sigma = 0.20;  ///< fraction of its height
  double grip_sigma = 0.10;         ///< fraction of its radius
  double head_sigma = 0.10;         ///< fraction of its radius
  double foot_forward_sigma_m = 0.008;
  double rake_sigma_rad = 0.08;  ///< about the template's usual one

  /// Log of the density without its constant; minus infinity outside the template's ranges and
  /// beyond three sigmas of any proportion: that is another kind of drill.
  double operator()(const DrillState& state) const;
  /// The diagonal of its information.
  DrillStep Information() const;
  /// Where the log of the density leads up: its slopes.
  DrillStep Gradient(const DrillState& state) const;
};

/// A prior that hardly knows how drills are built: head and foot may be what fits best.
DrillPrior AnyProportions(DrillPrior prior);

/// The same drill turned by 180 deg about its origin, leaning the same way in space. What of the
/// lean a grip turned round can hardly have, the whole drill takes over, as far as it may lean.
DrillState Flipped(const DrillState& state, const DrillPrior& prior);

/// Difference of two directions in [0, pi].
double TurnBetween(double yaw_a, double yaw_b);

DrillCandidate CandidateOf(const DrillState& state, const TableFrame& base_from_table);

}  // namespace foresight
