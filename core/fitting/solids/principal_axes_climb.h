#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/fitting/solids/pattern_search.h"

namespace foresight {

/// A score near a place as a paraboloid: where it leads up, and how sharply it bends.
struct ScoreShape {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;  ///< its negative second derivative; positive definite
};

/// The last part of a climb: what coarse steps along single parameters left over where parameters
/// have to change together. First Gauss-Newton steps, shortened until they lead up, then a pattern
/// search along the principal axes of the information (Brent 1973), whose first steps are two
/// deviations long. The shape may be rough, and may know a part of the score only: a step is taken
/// where the score itself is higher. The score of the result is never below `start.score`.
PatternSearchResult ClimbAlongPrincipalAxes(
    const PatternSearchResult& start, const std::function<double(const Eigen::VectorXd&)>& score,
    const std::function<ScoreShape(const Eigen::VectorXd&)>& shape_at);

}  // namespace foresight
