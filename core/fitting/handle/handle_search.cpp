#include "core/fitting/handle/handle_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/fitting/best_distinct.h"
#include "core/fitting/solids/pattern_search.h"

namespace foresight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr std::size_t kKept = 6;
constexpr double kLeastApart_m = 0.035, kMostApart_m = 0.30;
constexpr double kBesideBar_m = 0.018;
constexpr std::size_t kLeastOnBar = 4;
constexpr double kEndFraction = 0.04;  // of a bar's points that lie beyond what counts as its end
constexpr double kNever = -std::numeric_limits<double>::infinity();

/// A bar seen on the door: where it begins and ends, how far it stands off.
struct SeenBar {
  Eigen::Vector2d from, to;
  double front_m = 0.0;
};

std::optional<SeenBar> BarThrough(const Points& points, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b) {
  const Eigen::Vector2d first = a.head<2>(), way = b.head<2>() - first;
  const double apart_m = way.norm();
  if (apart_m < kLeastApart_m || apart_m > kMostApart_m) return std::nullopt;
  const Eigen::Vector2d along = way / apart_m;
  std::vector<double> places, heights;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d from = point.head<2>() - first;
    if (std::abs(along.x() * from.y() - along.y() * from.x()) > kBesideBar_m) continue;
    places.push_back(along.dot(from));
    heights.push_back(point.z());
  }
  if (places.size() < kLeastOnBar) return std::nullopt;
  return SeenBar{first + Quantile(places, kEndFraction) * along,
                 first + Quantile(places, 1.0 - kEndFraction) * along, Quantile(heights, 0.5)};
}

HandleState LeverOn(const SeenBar& bar, const FitHandleOptions& options) {
  const Eigen::Vector2d way = bar.to - bar.from;
  HandleState state;
  state.values[kHandleRadius] = HandlePrior::kRadius_m;
  state.values[kHandleTurn] = std::atan2(way.y(), way.x());
  // The rays that end on a round bar end before its middle.
  state.values[kHandleStandoff] =
      std::clamp(bar.front_m - 0.5 * HandlePrior::kRadius_m, 0.030, 0.090);
  state.values[kHandleLength] =
      std::clamp(way.norm() - HandlePrior::kRadius_m, options.min_length_m, options.max_length_m);
  state.values.head<2>() = bar.from + 0.5 * HandlePrior::kRadius_m * way.normalized();
  return state;
}

bool AlikeHandles(const HandleState& a, const HandleState& b) {
  return (a.values.head<2>() - b.values.head<2>()).norm() < 0.02 &&
         std::abs(std::remainder(a.values[kHandleTurn] - b.values[kHandleTurn],
                                 2.0 * std::numbers::pi)) < 0.25;
}

constexpr std::array kPivotsAlong = {0.12, 0.24, 0.36};  // of the whole bar

/// The variant of ends and plates that explains the rays best, the sizes as they are.
HandleState BestEnds(const HandleScorer& scorer, const HandleState& state) {
  HandleState best = state;
  best.score = scorer(state);
  for (HandleState& variant : VariantsOf(state)) {
    variant.score = scorer(variant);
    if (variant.score > best.score) best = variant;
  }
  return best;
}

/// ... and of pivots along the same bar.
HandleState BestVariant(const HandleScorer& scorer, const HandleState& state) {
  HandleState best = BestEnds(scorer, state);
  const HandleState with_ends = best;
  const double behind_m = state.values[kHandleBehind];
  const double bar_m = behind_m + state.values[kHandleLength];
  for (const double along : kPivotsAlong) {
    HandleState variant = WithPivotAlong(with_ends, along * bar_m - behind_m);
    variant.score = scorer(variant);
    if (variant.score > best.score) best = variant;
  }
  return best;
}

enum class Lengths { kAny, kAsItIs };
enum class Shape { kStraight, kBowed };

HandleState Climbed(const HandleScorer& scorer, const HandleState& start, double first_step_m,
                    int rounds, Shape shape, Lengths which = Lengths::kAny) {
  constexpr double kLever_m = 0.06;
  HandleStep lengths;
  lengths << first_step_m, first_step_m, first_step_m / kLever_m, 0.0, first_step_m, first_step_m,
      0.0, 0.0, 0.3 * first_step_m;
  PatternSearchOptions options;
  options.rounds = rounds;
  for (int i = 0; i < kHandleParameters; ++i)
    if (lengths[i] > 0.0 && (i != kHandleLength || which == Lengths::kAny))
      options.steps.push_back(lengths[i] * Eigen::VectorXd::Unit(kHandleParameters, i));
  // Off the door along the line of sight.
  Eigen::VectorXd off = Eigen::VectorXd::Zero(kHandleParameters);
  off.head<2>() = first_step_m * AlongSight(start, scorer.base_from_door.Inverse() *
                                                       scorer.likelihood.rays().viewpoint);
  off[kHandleStandoff] = first_step_m;
  options.steps.push_back(off);
  // The pivot's end by itself, while the other end stays; the pivot alone; and a turn about the
  // lever's middle.
  const double turn = start.values[kHandleTurn];
  Eigen::VectorXd pivot = Eigen::VectorXd::Zero(kHandleParameters);
  pivot[kHandleX] = -first_step_m * std::cos(turn);
  pivot[kHandleY] = -first_step_m * std::sin(turn);
  pivot[kHandleLength] = first_step_m;
  if (which == Lengths::kAny) {
    options.steps.push_back(pivot);
    pivot[kHandleBehind] = -first_step_m;
    options.steps.push_back(pivot);
  }
  Eigen::VectorXd about = Eigen::VectorXd::Zero(kHandleParameters);
  about[kHandleTurn] = first_step_m / kLever_m;
  about[kHandleX] = first_step_m * std::sin(turn);
  about[kHandleY] = -first_step_m * std::cos(turn);
  options.steps.push_back(about);
  if (shape == Shape::kBowed) {
    // A bar that bends stays where most of it was.
    constexpr double kMeanOfParabola = 2.0 / 3.0;
    Eigen::VectorXd bow = Eigen::VectorXd::Zero(kHandleParameters), lift = bow;
    bow[kHandleBow] = lift[kHandleLift] = first_step_m;
    bow[kHandleX] = kMeanOfParabola * first_step_m * std::sin(turn);
    bow[kHandleY] = -kMeanOfParabola * first_step_m * std::cos(turn);
    lift[kHandleStandoff] = -kMeanOfParabola * first_step_m;
    options.steps.push_back(bow);
    options.steps.push_back(lift);
  }
  const auto at = [&](const Eigen::VectorXd& values) {
    HandleState state = start;
    state.values = values;
    return state;
  };
  const PatternSearchResult found = ClimbByPatternSearch(
      start.values, [&](const Eigen::VectorXd& values) { return scorer(at(values)); }, options);
  HandleState climbed = at(found.values);
  climbed.score = found.score;
  return climbed;
}

}  // namespace

std::vector<HandleState> FindLevers(const HandleScorer& scorer, const Points& before_door,
                                    Random& random, const RunContext& context) {
  std::vector<HandleState> found;
  const int count = static_cast<int>(before_door.size());
  for (int trial = 0; count > 1 && trial < scorer.options.pair_trials; ++trial) {
    const auto& a = before_door[static_cast<std::size_t>(random.Index(count))];
    const auto& b = before_door[static_cast<std::size_t>(random.Index(count))];
    const auto bar = BarThrough(before_door, a, b);
    if (!bar || !((bar->to - bar->from).norm() > 0.02)) continue;
    found.push_back(LeverOn(*bar, scorer.options));
  }
  const auto score = [&](int i) {
    HandleState& state = found[static_cast<std::size_t>(i)];
    state.score = scorer(state);
  };
  if (!ParallelFor(static_cast<int>(found.size()), context, score)) return {};
  std::erase_if(found, [](const HandleState& state) { return !std::isfinite(state.score); });
  KeepBestDistinct(kKept, &HandleState::score, AlikeHandles, found);
  return found;
}

HandleState LocalSearch(const HandleScorer& scorer, HandleState start, HandleEffort effort) {
  if (effort == HandleEffort::kCoarse) return Climbed(scorer, start, 0.012, 3, Shape::kStraight);
  start = Climbed(scorer, start, 0.008, 3, Shape::kStraight);
  return Climbed(scorer, BestVariant(scorer, start), 0.006, 4,
                 effort == HandleEffort::kFinest ? Shape::kBowed : Shape::kStraight);
}

HandleState OtherLength(const HandleScorer& scorer, const HandleState& lever, double longer_m) {
  HandleState best;
  best.score = kNever;
  HandleState at_end = lever, at_pivot = WithPivotAlong(lever, -longer_m);
  at_end.values[kHandleLength] += longer_m;
  at_pivot.values[kHandleBehind] = lever.values[kHandleBehind];
  // On the same bar the pivot may be anywhere: the post may be hidden.
  HandleState along = WithPivotAlong(lever, -longer_m);
  along.score = scorer(along);
  for (const double further : {2.0, 3.0}) {
    HandleState other = WithPivotAlong(lever, -further * longer_m);
    other.score = scorer(other);
    if (other.score > along.score) along = other;
  }
  for (HandleState other : {at_end, at_pivot, along}) {
    if (!std::isfinite(scorer(other))) continue;
    other = Climbed(scorer, other, 0.006, 3, Shape::kBowed, Lengths::kAsItIs);
    if (other.score > best.score) best = other;
  }
  return best;
}

}  // namespace foresight
