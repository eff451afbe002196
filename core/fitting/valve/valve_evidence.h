#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "core/fitting/beam_footprints.h"
#include "core/fitting/ray_set.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// The place and the axis of a fit that is right are off by less (docs/evaluation.md).
inline constexpr double kRightPlace_m = 0.020;
inline constexpr double kRightAxis_rad = 5.0 * std::numbers::pi / 180.0;

/// What the rays of a region say about a valve. A ray intersects it where half of its footprint
/// lies on it. Members in nats and in deviations over lines are left at 0.
ValveEvidence GatherEvidence(const BeamFootprints& footprints, const ValveCandidate& valve);

/// Fills the covariance and the deviations of a detection from the information of its best
/// candidate, as if each beam were an independent measurement and the sections were known.
/// WidenSigmas follows. A direction that no ray sees has a deviation of about a turn or a metre;
/// the phase of a disc is NaN in the covariance.
void SetSigmas(const ValveInformation& information, ValveDetection& detection);

/// Fills in a covariance about the object's axes and the deviations that it says; the phase of a
/// disc is NaN.
void SetCovariance(const PoseCovariance& covariance, ValveDetection& detection);

/// Independent measurements on the valve: a map without its beams has fewer than rays. The evidence
/// is that of the beams behind a map where they are known.
double MeasuredHits(const RaySet& rays, const ValveEvidence& evidence);

/// In base: of a wheel its centre, of a lever halfway along its bar.
Eigen::Vector3d MiddleOf(const ValveCandidate& valve);

/// How little it can be what the region was drawn round, however well it fits: 0 = it can, 1 = it
/// is too far from the region's middle or outside of its box, 2 = it is a lever as long as they
/// get, which a pipe that runs on through the region looks like, 3 = both.
int Misplacement(const RaySet& rays, const ValveCandidate& valve);

/// The chance that place or axis are off by more than is called right, by the deviations.
double ChanceOfBeingOff(const ValveDetection& detection);

/// What the probability of a verdict is computed from, in the order of the names. The detection's
/// evidence, sigmas and candidates are filled in.
std::vector<std::string> ValveFeatureNames();
std::vector<double> ValveFeatures(const RaySet& rays, const ValveDetection& detection);

}  // namespace foresight
