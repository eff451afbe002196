#include "core/fitting/drill/pattern_search.h"

namespace foresight {

PatternSearchResult ClimbByPatternSearch(const Eigen::VectorXd& start,
                                         const std::function<double(const Eigen::VectorXd&)>& score,
                                         const PatternSearchOptions& options) {
  PatternSearchResult best{start, score(start)};
  double size = 1.0;
  for (int round = 0; round < options.rounds; ++round, size *= 0.5) {
    for (int pass = 0; pass < options.passes; ++pass) {
      bool moved = false;
      for (const Eigen::VectorXd& step : options.steps) {
        for (const double sign : {size, -size}) {
          Eigen::VectorXd tried = best.values + sign * step;
          const double tried_score = score(tried);
          if (!(tried_score > best.score)) continue;
          best = {std::move(tried), tried_score};
          moved = true;
          break;
        }
      }
      if (!moved) break;
    }
  }
  return best;
}

}  // namespace foresight
