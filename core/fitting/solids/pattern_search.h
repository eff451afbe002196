#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace foresight {

struct PatternSearchOptions {
  std::vector<Eigen::VectorXd> steps;  ///< directions to try, each as long as its first step
  int rounds = 5;                      ///< each halves the steps
  int passes = 2;                      ///< over all steps in a round
};

struct PatternSearchResult {
  Eigen::VectorXd values;
  double score = 0.0;
};

/// Climbs a function that is not smooth by trying steps both ways, shrinking them. Where both lead
/// down, the top of the parabola through the three scores is tried, and the direction rests for a
/// while (Brent 1973 interpolates so along a line). The score of the result is never below that of
/// the start.
PatternSearchResult ClimbByPatternSearch(const Eigen::VectorXd& start,
                                         const std::function<double(const Eigen::VectorXd&)>& score,
                                         const PatternSearchOptions& options);

}  // namespace foresight
