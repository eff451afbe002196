#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/base/random.h"
#include "core/fitting/beam_likelihood.h"
#include "core/fitting/valve/rim_search.h"
#include "core/fitting/valve/valve_state.h"

namespace foresight {

/// A rim as a valve without spokes.
ValveCandidate RimFrom(const RimHypothesis& rim, double tube_radius_m);

/// The most likely few rims that differ from each other, the best first.
void KeepDistinctRims(std::size_t most, std::vector<ValveCandidate>& rims);

/// A rim that is thinner than the beams reads anywhere between itself and the wall, on no circle;
/// the beams that read too short lie on a cone all the same. The most likely few of the circles in
/// which such cones cut planes across `search.facing`, with one of several widths each. Points in
/// base; `coarse` judges.
std::vector<ValveCandidate> SearchThinRims(const std::vector<Eigen::Vector3d>& points,
                                           const Eigen::Vector3d& viewpoint,
                                           const BeamLikelihood& coarse, RimSearchOptions search,
                                           Random& random);

}  // namespace foresight
