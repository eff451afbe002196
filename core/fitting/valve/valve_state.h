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
  kDish,        ///< a lever has none
  kBrightness,  ///< its logarithm
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
  /// A straight bar looks the same turned about itself: its axis is taken to be the wall's normal.
  static constexpr double kLeverTiltSigma_rad = 0.03;
};

/// A valve of usual proportions: spokes thinner than the rim's tube, a hub of a fifth of the rim.
ValveModel UsualValve(double rim_radius_m, double tube_radius_m, int spokes, double dish_m);

/// A lever of usual proportions.
ValveModel UsualLever(double length_m, double tube_radius_m);

/// The valve after a step. Radii and dish stay within what is built.
ValveCandidate Moved(const ValveCandidate& valve, const ValveStep& step);

/// Sine of the angle by which a lever is turned about its bar from the wall's normal; 0 without a
/// wall, and for a wheel.
double LeverTilt(const ValveCandidate& valve, const std::optional<Plane>& wall);

/// Log of the prior's density, without its constant.
double LogPrior(const ValveCandidate& valve, const std::optional<Plane>& wall);

/// The same wheel with x along the spoke that points most nearly up (-y of base), so that a fit's
/// answer does not jump between equivalent spokes.
ValveCandidate WithUpwardSpoke(const ValveCandidate& valve);

/// The pose of a wheel with a given axis; x is up in base, as far as it can be.
Rigid<frame::Base, frame::Object> PoseFromAxis(const Eigen::Vector3d& center,
                                               const Eigen::Vector3d& axis);

}  // namespace foresight
