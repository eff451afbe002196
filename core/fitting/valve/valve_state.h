#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/fitting/valve/valve_detection.h"
#include "core/geometry/plane.h"

namespace foresight {

/// What a fit may change of a valve, as a small step in the object's own frame.
enum ValveParameter {
  kMoveX,
  kMoveY,
  kMoveZ,
  kTiltX,
  kTiltY,
  kPhase,
  kRimRadius,  ///< or a lever's length
  kTubeRadius,
  kDish,        ///< or the radius of a lever's head
  kBrightness,  ///< its logarithm
  kRimDepth,    ///< half of it, along the axis; a lever has none of the last three
  kSpokeRadius,
  kSpokeDepth,
  kValveParameters
};
using ValveStep = Eigen::Matrix<double, kValveParameters, 1>;
using ValveInformation = Eigen::Matrix<double, kValveParameters, kValveParameters>;

/// Which parts of the template a fit looks at.
enum class ValveParts { kRim, kAll };

/// How handwheels are built; keeps parameters that the measurements hardly see from running away.
struct ValvePrior {
  static constexpr double kTubeRadius_m = 0.013;
  static constexpr double kTubeRadiusSigma_m = 0.004;
  static constexpr double kDish_m = 0.020;
  static constexpr double kDishSigma_m = 0.050;
  static constexpr double kBrightnessSigma = 0.4;  ///< of the logarithm
  /// Of sections, of the logarithm: half a rim's depth, half a spoke's width and depth. A bar may
  /// lie flat or stand upright: depths do not go with widths. Real rims' depths scatter more, but
  /// beams see no depth: a footprint that is not ours looks like a deep rim by tens of nats, and
  /// the wheel moves back along its axis to keep its front. Hence a prior that holds against that,
  /// chosen on training scenes (docs/evaluation/valve.md, "A rim's depth is not seen").
  static constexpr double kRimDepth_m = 0.008;
  static constexpr double kRimDepthSigma = 0.1;
  static constexpr double kSpokeRadius_m = 0.008;
  static constexpr double kSpokeDepth_m = 0.007;
  static constexpr double kSectionSigma = 0.5;
  static constexpr double kHeadRadius_m = 0.025;  ///< of a lever
  static constexpr double kHeadRadiusSigma_m = 0.006;
  /// Most valves are mounted square to the wall behind them, the others at any angle: two normal
  /// densities of the axis about the wall's normal, with these sigmas and this fraction of the
  /// first.
  static constexpr double kSquareFraction = 0.7;
  static constexpr double kSquareSigma_rad = 0.035;
  static constexpr double kSkewSigma_rad = 0.21;
  /// A lever's bar and head look the same turned about the bar: that turn is taken to be square.
  static constexpr double kLeverTurnSigma_rad = 0.03;
};

/// A valve of usual proportions: round sections, spokes thinner than the rim's tube, a hub of a
/// fifth of the rim.
ValveModel UsualValve(double rim_radius_m, double tube_radius_m, int spokes, double dish_m);

inline constexpr double kMaxLeverLength_m = 0.45;

/// A lever; its sizes are kept within what is built.
ValveModel UsualLever(double length_m, double tube_radius_m,
                      double head_radius_m = ValvePrior::kHeadRadius_m);

/// The valve after a step. Radii, depths and dish stay within what is built. A section's depth does
/// not change with its width.
ValveCandidate Retract(const ValveCandidate& valve, const ValveStep& step);

/// What the prior of an axis square to the wall counts in a sum of squares: components along the
/// object's x and y, of which half the squared length is the prior's -log, 0 where the axis is the
/// wall's normal; 0 without a wall.
Eigen::Vector2d AxisPriorResiduals(const ValveCandidate& valve, const std::optional<Plane>& wall);

/// A wheel's dish or a lever's head against the usual, in sigmas of the prior.
double OwnSizeResidual(const ValveModel& model);

/// A wheel's sections against the usual, in sigmas of the prior: depth of the rim, width and depth
/// of the spokes. 0 of a lever; of a disc but the first.
Eigen::Vector3d SectionResiduals(const ValveModel& model);

/// Log of the prior's density, without its constant.
double LogPrior(const ValveCandidate& valve, const std::optional<Plane>& wall);

/// The same wheel with x along the spoke that points most nearly up (-y of base), so that a fit's
/// answer does not jump between equivalent spokes.
ValveCandidate WithUpwardSpoke(const ValveCandidate& valve);

/// The pose of a wheel with a given axis; x is up in base, as far as it can be.
Rigid<frame::Base, frame::Object> PoseFromAxis(const Eigen::Vector3d& center,
                                               const Eigen::Vector3d& axis);

}  // namespace foresight
