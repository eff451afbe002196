#include "core/fitting/solids/pattern_search.h"

#include <cmath>
#include <limits>
#include <utility>

namespace foresight {
namespace {

// Of a step: a top that is nearer is not worth a try, and one that is nearer than this leaves
// nothing for a step half as long (docs/performance.md, "A parabola along each direction").
constexpr double kNearTop = 0.1;
constexpr double kNothingLeft = 0.25;

/// What was seen along one direction.
struct SearchDirection {
  double sign = 1.0;         ///< which way was uphill last
  int rests_until_pass = 0;  ///< of all passes
};

/// Where the parabola through three scores is highest, in steps from the middle one. NaN where it
/// is not highest anywhere.
double TopOfParabola(double behind, double middle, double ahead) {
  const double bend = 2.0 * middle - ahead - behind;
  return std::isfinite(bend) && bend > 0.0 ? 0.5 * (ahead - behind) / bend
                                           : std::numeric_limits<double>::quiet_NaN();
}

class Climb {
 public:
  Climb(const Eigen::VectorXd& start, const std::function<double(const Eigen::VectorXd&)>& score)
      : score_(score), best_{start, score(start)} {}

  const PatternSearchResult& Best() const { return best_; }

  /// Whether it is better; then it is the best.
  bool Try(Eigen::VectorXd values) {
    last_score_ = score_(values);
    if (!(last_score_ > best_.score)) return false;
    best_ = {std::move(values), last_score_};
    return true;
  }

  /// A step either way or, where both lead down, to the top between them. Whether a step half as
  /// long along the same direction may find anything.
  bool Step(const Eigen::VectorXd& step, SearchDirection& direction) {
    if (Try(best_.values + direction.sign * step)) return true;
    const double ahead = last_score_;
    if (Try(best_.values - direction.sign * step)) {
      direction.sign = -direction.sign;
      return true;
    }
    const double top = TopOfParabola(last_score_, best_.score, ahead);
    const bool moved = std::abs(top) > kNearTop && Try(best_.values + top * direction.sign * step);
    return moved || !(std::abs(top) < kNothingLeft);
  }

 private:
  const std::function<double(const Eigen::VectorXd&)>& score_;
  PatternSearchResult best_;
  double last_score_ = 0.0;
};

}  // namespace

PatternSearchResult ClimbByPatternSearch(const Eigen::VectorXd& start,
                                         const std::function<double(const Eigen::VectorXd&)>& score,
                                         const PatternSearchOptions& options) {
  Climb climb(start, score);
  std::vector<SearchDirection> directions(options.steps.size());
  double size = 1.0;
  for (int round = 0; round < options.rounds; ++round, size *= 0.5) {
    for (int pass = 0; pass < options.passes; ++pass) {
      const Eigen::VectorXd before = climb.Best().values;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        SearchDirection& direction = directions[i];
        if (round * options.passes + pass < direction.rests_until_pass) continue;
        // Until the second pass of the next round: others will have moved by then.
        if (!climb.Step(size * options.steps[i], direction))
          direction.rests_until_pass = (round + 1) * options.passes + 1;
      }
      if (climb.Best().values == before) break;
      // Once more the way this pass went: along a narrow ridge single steps only zigzag.
      climb.Try(2.0 * climb.Best().values - before);
    }
  }
  return climb.Best();
}

}  // namespace foresight
