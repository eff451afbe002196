#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/fitting/cylinder/cylinder_state.h"

namespace foresight {

/// Cylinders worth a local search, the best first and no two alike: circles through three points
/// that belong to none of the planes, seen along each of many directions, `up` and the points' own
/// main directions first. Scored by the few rays of `likelihood`.
std::vector<CylinderState> FindCylinders(const BeamLikelihood& likelihood,
                                         const std::vector<Eigen::Vector3d>& points,
                                         const Eigen::Vector3d& up, const CylinderBounds& bounds,
                                         Random& random);

}  // namespace foresight
