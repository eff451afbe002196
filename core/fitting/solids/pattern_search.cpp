#include "core/fitting/solids/pattern_search.h"

namespace foresight {

PatternSearchResult ClimbByPatternSearch(const Eigen::VectorXd& start,
                                         const std::function<double(const Eigen::VectorXd&)>& score,
                                         const PatternSearchOptions& options) {
  PatternSearchResult best{start, score(start)};
  const auto better = [&](Eigen::VectorXd tried) {
    const double tried_score = score(tried);
    if (!(tried_score > best.score)) return false;
    best = {std::move(tried), tried_score};
    return true;
  };
  double size = 1.0;
  for (int round = 0; round < options.rounds; ++round, size *= 0.5) {
    for (int pass = 0; pass < options.passes; ++pass) {
      const Eigen::VectorXd before = best.values;
      for (const Eigen::VectorXd& step : options.steps)
        if (!better(best.values + size * step)) better(best.values - size * step);
      if (best.values == before) break;
      // Once more the way this pass went: along a narrow ridge single steps only zigzag.
      better(2.0 * best.values - before);
    }
  }
  return best;
}

}  // namespace foresight
