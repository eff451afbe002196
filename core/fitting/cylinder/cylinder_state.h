#pragma once

#include <Eigen/Core>

#include "core/fitting/beam_likelihood.h"
#include "core/objects/solid_part.h"

namespace foresight {

/// How beams before a cylinder are looked at where nothing is known of their footprints, and in a
/// coarse search: no real pole is smooth and straight.
inline constexpr BeamOptions kRoundCylinderBeams;
/// The same where footprints are known (RaySet::footprint_height_rad): a pipe is hardly wider than
/// one, which reads in between it and its wall.
BeamOptions CylinderBeams(const RaySet& rays);

/// A cylinder while it is looked for.
struct CylinderState {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< in base
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< in base, length 1
  double radius_m = 0.0;
  double length_m = 0.0;
  double score = 0.0;

  Eigen::Vector3d FromAxis(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d from = point - middle;
    return from - from.dot(axis) * axis;
  }
  /// A part in base, its frame being the object's.
  SolidPart Part() const;
};

/// What a cylinder can change by: two shifts across its axis, two tilts, radius (metres, radians),
/// and where it begins and ends.
inline constexpr int kCylinderParameters = 7;
using CylinderStep = Eigen::Matrix<double, kCylinderParameters, 1>;
CylinderState Retract(const CylinderState& cylinder, const CylinderStep& step);

struct CylinderBounds {
  double min_radius_m = 0.010;
  double max_radius_m = 0.600;
};

/// Log likelihood of all rays of one solid, whose frame is base.
double LogLikelihoodOf(const SolidPart& solid_in_base, const BeamLikelihood& likelihood);

/// Log likelihood of all rays; minus infinity outside the bounds or for a length below a radius'
/// half.
double ScoreOf(const CylinderState& cylinder, const BeamLikelihood& likelihood,
               const CylinderBounds& bounds);

/// Climbs the likelihood by steps that shrink from `first_step_m`, over as many rounds.
CylinderState AfterLocalSearch(const CylinderState& cylinder, const BeamLikelihood& likelihood,
                               const CylinderBounds& bounds, double first_step_m, int rounds);

}  // namespace foresight
