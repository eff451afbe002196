#include "core/fitting/handle/handle_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/fitting/best_distinct.h"
#include "core/fitting/solids/pattern_search.h"
#include "core/fitting/solids/solid_tracer.h"

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

HandleState Climbed(const HandleScorer& scorer, const HandleState& start, double first_step_m,
                    int rounds, Lengths which = Lengths::kAny) {
  constexpr double kLever_m = 0.06;
  HandleStep lengths;
  lengths << first_step_m, first_step_m, first_step_m / kLever_m, first_step_m, first_step_m,
      first_step_m, 0.3 * first_step_m;
  PatternSearchOptions options;
  options.rounds = rounds;
  for (int i = 0; i < kHandleParameters; ++i)
    if (i != kHandleLength || which == Lengths::kAny)
      options.steps.push_back(lengths[i] * Eigen::VectorXd::Unit(kHandleParameters, i));
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

using MakeThing = std::function<double(const Eigen::VectorXd&)>;

double BestOf(const std::vector<Eigen::VectorXd>& starts, const Eigen::VectorXd& steps,
              const MakeThing& score) {
  PatternSearchOptions options;
  options.rounds = 4;
  for (int i = 0; i < steps.size(); ++i)
    options.steps.push_back(steps[i] * Eigen::VectorXd::Unit(steps.size(), i));
  double best = kNever;
  for (const Eigen::VectorXd& start : starts)
    best = std::max(best, ClimbByPatternSearch(start, score, options).score);
  return best;
}

Rigid<frame::Base, frame::Object> PlacedAt(const DoorFrame& base_from_door, double x, double y,
                                           double z, double turn_rad) {
  return base_from_door *
         Rigid<frame::Object, frame::Object>(
             Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ())), {x, y, z});
}

/// A ball on a neck and a rosette: x, y, height of its middle, radius.
double BestKnob(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
                const std::vector<Eigen::Vector2d>& places) {
  const auto score = [&](const Eigen::VectorXd& v) {
    if (v[2] < 0.015 || v[2] > 0.10 || v[3] < 0.012 || v[3] > 0.05) return kNever;
    const std::vector<HandleBar> bars = {{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), v[3]},
                                         {Eigen::Vector3d::Zero(), {0.0, 0.0, -v[2]}, 0.4 * v[3]}};
    const DoorThing::Plate plate{HandleModel::kPlateThickness_m - v[2],
                                 HandleModel::kRosetteRadius_m, Eigen::Vector2d::Zero()};
    return LogLikelihoodOf(DoorThing(bars, plate, PlacedAt(base_from_door, v[0], v[1], v[2], 0.0)),
                           likelihood);
  };
  std::vector<Eigen::VectorXd> starts;
  for (const Eigen::Vector2d& place : places)
    starts.push_back(Eigen::Vector4d(place.x(), place.y(), 0.045, 0.026));
  return BestOf(starts, Eigen::Vector4d(0.012, 0.012, 0.010, 0.008), score);
}

/// Log likelihood of a bar (middle, turn, height, length, radius) on posts along it.
double BarOnPosts(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
                  const Eigen::VectorXd& v, double most_length_m,
                  std::initializer_list<double> posts_m) {
  if (v[3] < 0.02 || v[3] > 0.10 || v[4] < 0.05 || v[4] > most_length_m || v[5] < 0.004 ||
      v[5] > 0.022)
    return kNever;
  const Eigen::Vector3d end(0.5 * v[4], 0.0, 0.0);
  std::vector<HandleBar> bars = {{-end, end, v[5]}};
  for (const double post_m : posts_m)
    bars.push_back({{post_m, 0.0, 0.0}, {post_m, 0.0, -v[3]}, v[5]});
  return LogLikelihoodOf(
      DoorThing(bars, std::nullopt, PlacedAt(base_from_door, v[0], v[1], v[3], v[2])), likelihood);
}

/// Where a bar is looked for first, as the handle's lever is.
Eigen::VectorXd BarLike(const HandleState& handle, const Eigen::Vector2d& middle, double length_m) {
  const HandleStep& h = handle.values;
  Eigen::VectorXd bar(6);
  bar << middle.x(), middle.y(), h[kHandleTurn], h[kHandleStandoff], length_m, h[kHandleRadius];
  return bar;
}

Eigen::VectorXd BarSteps() {
  Eigen::VectorXd steps(6);
  steps << 0.010, 0.010, 0.12, 0.008, 0.016, 0.003;
  return steps;
}

Eigen::VectorXd With(const Eigen::VectorXd& values, double last) {
  Eigen::VectorXd more(values.size() + 1);
  more << values, last;
  return more;
}

/// A bar on two posts, and how far these stand from its ends.
double BestPullBar(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
                   const HandleState& handle, const Eigen::Vector2d& middle, double largest_m) {
  constexpr double kMostInset = 0.35;  // of the length
  const auto score = [&](const Eigen::VectorXd& v) {
    if (v[6] < 0.0 || v[6] > kMostInset * v[4]) return kNever;
    const double post_m = 0.5 * v[4] - v[6];
    return BarOnPosts(likelihood, base_from_door, v, 0.6, {-post_m, post_m});
  };
  const double lever_m = handle.values[kHandleLength], long_m = std::max(lever_m, largest_m);
  std::vector<Eigen::VectorXd> starts = {With(BarLike(handle, middle, lever_m), 0.0),
                                         With(BarLike(handle, middle, long_m), 0.2 * long_m)};
  if (long_m > lever_m) starts.push_back(With(BarLike(handle, middle, long_m), 0.0));
  return BestOf(starts, With(BarSteps(), 0.012), score);
}

/// A bar on one post in its middle.
double BestBarOnPost(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
                     const HandleState& handle, const std::vector<Eigen::Vector2d>& middles) {
  const auto score = [&](const Eigen::VectorXd& v) {
    return BarOnPosts(likelihood, base_from_door, v, 0.4, {0.0});
  };
  std::vector<Eigen::VectorXd> starts;
  for (const Eigen::Vector2d& middle : middles)
    starts.push_back(BarLike(handle, middle, handle.values[kHandleLength]));
  return BestOf(starts, BarSteps(), score);
}

/// A rod bent from foot to foot: middle, turn, height, length, radius.
double BestBow(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
               const HandleState& handle, const Eigen::Vector2d& middle, double largest_m) {
  constexpr int kPieces = 6;
  const auto score = [&](const Eigen::VectorXd& v) {
    if (v[3] < 0.02 || v[3] > 0.10 || v[4] < 0.05 || v[4] > 0.4 || v[5] < 0.003 || v[5] > 0.018)
      return kNever;
    const auto at = [&](int i) {
      const double angle = std::numbers::pi * i / kPieces;
      return Eigen::Vector3d(0.5 * v[4] * std::cos(angle), 0.0,
                             v[3] * std::sqrt(std::max(0.0, std::sin(angle))));
    };
    std::vector<HandleBar> bars;
    for (int i = 0; i < kPieces; ++i) bars.push_back({at(i), at(i + 1), v[5]});
    return LogLikelihoodOf(
        DoorThing(bars, std::nullopt, PlacedAt(base_from_door, v[0], v[1], 0.0, v[2])), likelihood);
  };
  const HandleStep& h = handle.values;
  std::vector<Eigen::VectorXd> starts;
  for (const double length_m : {1.3 * h[kHandleLength], largest_m + 0.03}) {
    Eigen::VectorXd start(6);
    start << middle.x(), middle.y(), h[kHandleTurn], h[kHandleStandoff], length_m,
        0.7 * h[kHandleRadius];
    starts.push_back(start);
  }
  Eigen::VectorXd steps(6);
  steps << 0.010, 0.010, 0.12, 0.008, 0.020, 0.003;
  return BestOf(starts, steps, score);
}

/// A box on the door: middle, turn, length, height, how far it stands out.
double BestBox(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
               const HandleState& handle, const Eigen::Vector2d& middle, double largest_m) {
  const auto score = [&](const Eigen::VectorXd& v) {
    if (v.tail<3>().minCoeff() < 0.006 || v.tail<3>().maxCoeff() > 0.6 || v[5] > 0.15)
      return kNever;
    SolidPart box;
    box.shape = SolidPart::Shape::kBox;
    box.size_m = v.tail<3>();
    const auto pose = PlacedAt(base_from_door, v[0], v[1], 0.5 * v[5], v[2]);
    const SolidTracer tracer({&box, 1}, pose);
    const OutlineSupport outline = likelihood.rays().image
                                       ? likelihood.rays().image->SupportOf({&box, 1}, pose)
                                       : OutlineSupport();
    return outline.nats + likelihood([&tracer](const RangeRay& ray,
                                               double reach_m) -> std::optional<BeamIntersection> {
             const SolidIntersection passed = tracer.IntersectWithDepth(ray, reach_m);
             if (passed.part < 0) return std::nullopt;
             return BeamIntersection{passed.clearance_m, passed.range_m};
           });
  };
  const HandleStep& h = handle.values;
  std::vector<Eigen::VectorXd> starts;
  for (const double width_m : {0.03, 0.5 * largest_m}) {
    Eigen::VectorXd start(6);
    start << middle.x(), middle.y(), h[kHandleTurn], std::max(largest_m, 0.02),
        std::clamp(width_m, 0.02, 0.3), h[kHandleStandoff];
    starts.push_back(start);
  }
  Eigen::VectorXd steps(6);
  steps << 0.010, 0.010, 0.12, 0.016, 0.012, 0.010;
  return BestOf(starts, steps, score);
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
  if (effort == HandleEffort::kCoarse) return Climbed(scorer, start, 0.012, 3);
  start = Climbed(scorer, start, 0.008, 3);
  return Climbed(scorer, BestVariant(scorer, start), 0.006, 4);
}

HandleState OtherLength(const HandleScorer& scorer, const HandleState& lever, double longer_m) {
  HandleState best;
  best.score = kNever;
  HandleState at_end = lever, at_pivot = WithPivotAlong(lever, -longer_m);
  at_end.values[kHandleLength] += longer_m;
  at_pivot.values[kHandleBehind] = lever.values[kHandleBehind];
  for (HandleState other : {at_end, at_pivot, WithPivotAlong(lever, -longer_m)}) {
    if (!std::isfinite(scorer(other))) continue;
    other = Climbed(scorer, other, 0.006, 3, Lengths::kAsItIs);
    if (other.score > best.score) best = other;
  }
  return best;
}

std::vector<HandleAlternative> FitHandleAlternatives(const BeamLikelihood& likelihood,
                                                     const DoorFrame& base_from_door,
                                                     const HandleState& handle,
                                                     const Points& before_door,
                                                     const RunContext& context) {
  const HandleStep& h = handle.values;
  const Eigen::Vector2d way(std::cos(h[kHandleTurn]), std::sin(h[kHandleTurn]));
  const Eigen::Vector2d pivot = h.head<2>();
  const Eigen::Vector2d middle = pivot + 0.5 * (h[kHandleLength] - h[kHandleBehind]) * way;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double low = 1e9, high = -1e9;
  for (const Eigen::Vector3d& point : before_door) {
    mean += point.head<2>() / static_cast<double>(before_door.size());
    low = std::min(low, way.dot(point.head<2>()));
    high = std::max(high, way.dot(point.head<2>()));
  }
  const Eigen::Vector2d seen = mean + (0.5 * (low + high) - way.dot(mean)) * way;
  const double largest_m = high - low;
  std::array<double, 7> best{};
  const std::function<double()> climbs[best.size()] = {
      [&] {
        return BestKnob(likelihood, base_from_door, {pivot, middle, mean});
      },
      [&] { return BestPullBar(likelihood, base_from_door, handle, middle, 0.0); },
      [&] { return BestPullBar(likelihood, base_from_door, handle, seen, largest_m); },
      [&] { return BestBow(likelihood, base_from_door, handle, seen, largest_m); },
      [&] {
        return BestBarOnPost(likelihood, base_from_door, handle, {middle, seen});
      },
      [&] { return BestBox(likelihood, base_from_door, handle, middle, h[kHandleLength]); },
      [&] { return BestBox(likelihood, base_from_door, handle, seen, largest_m); }};
  ParallelFor(static_cast<int>(best.size()), context,
              [&](int i) { best[static_cast<std::size_t>(i)] = climbs[i](); });
  return {{"knob", 4, best[0]},
          {"pull bar", 7, std::max(best[1], best[2])},
          {"bow", 6, best[3]},
          {"bar on a post", 6, best[4]},
          {"box", 6, std::max(best[5], best[6])}};
}

}  // namespace foresight
