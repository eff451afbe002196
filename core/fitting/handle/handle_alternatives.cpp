#include "core/fitting/handle/handle_alternatives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/parallel.h"
#include "core/fitting/solids/pattern_search.h"
#include "core/fitting/solids/solid_coverage.h"
#include "core/fitting/solids/solid_tracer.h"

namespace foresight {
namespace {

constexpr double kBesideLever_m = 0.030;  // of a bar that may be bowed
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

using ScoreOf = std::function<double(const Eigen::VectorXd&)>;

PatternSearchResult BestThing(const std::vector<Eigen::VectorXd>& starts,
                              const Eigen::VectorXd& steps, const ScoreOf& score, int rounds = 4) {
  PatternSearchOptions options;
  options.rounds = rounds;
  for (int i = 0; i < steps.size(); ++i)
    options.steps.push_back(steps[i] * Eigen::VectorXd::Unit(steps.size(), i));
  PatternSearchResult best;
  best.score = kImpossible;
  for (const Eigen::VectorXd& start : starts)
    if (PatternSearchResult found = ClimbByPatternSearch(start, score, options);
        found.score > best.score)
      best = std::move(found);
  return best;
}

double BestOf(const std::vector<Eigen::VectorXd>& starts, const Eigen::VectorXd& steps,
              const ScoreOf& score) {
  return BestThing(starts, steps, score).score;
}

Eigen::VectorXd With(const Eigen::VectorXd& values, double last) {
  Eigen::VectorXd more(values.size() + 1);
  more << values, last;
  return more;
}

/// On the door, of what stands that far off it.
DoorThing::Plate RosetteAt(double x_m, double standoff_m) {
  DoorThing::Plate rosette = PlateOf(HandleModel::Plate::kRosette, standoff_m);
  rosette.at.x() = x_m;
  return rosette;
}

/// What the posts of a bar stand on.
enum class Feet { kBare, kRosettes };

using ScoreOnFeet = std::function<double(const Eigen::VectorXd&, Feet)>;

/// Where a thing lies on the door: its frame is turned by `turn_rad` about the door's normal.
struct OnTheDoor {
  Eigen::Vector2d at;
  double off_m = 0.0;
  double turn_rad = 0.0;
};

/// What else may be there, with its parameters in vectors for the pattern search.
class OtherThings {
 public:
  OtherThings(const BeamLikelihood& likelihood, const DoorFrame& base_from_door,
              const HandleState& handle)
      : likelihood_(likelihood), base_from_door_(base_from_door), handle_(handle) {}

  /// A ball on a neck and a rosette: x, y, height of its middle, radius.
  double BestKnob(const std::vector<Eigen::Vector2d>& places) const {
    const auto score = [&](const Eigen::VectorXd& v) {
      if (v[2] < 0.015 || v[2] > 0.10 || v[3] < 0.012 || v[3] > 0.05) return kImpossible;
      return Score({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), v[3]},
                    {Eigen::Vector3d::Zero(), {0.0, 0.0, -v[2]}, 0.4 * v[3]}},
                   {RosetteAt(0.0, v[2])}, {{v[0], v[1]}, v[2]});
    };
    std::vector<Eigen::VectorXd> starts;
    for (const Eigen::Vector2d& place : places)
      starts.push_back(Eigen::Vector4d(place.x(), place.y(), 0.045, 0.026));
    return BestOf(starts, Eigen::Vector4d(0.012, 0.012, 0.010, 0.008), score);
  }

  /// A bar on two posts, and how far these stand from its ends.
  double BestPullBar(const Eigen::Vector2d& middle, double largest_m) const {
    constexpr double kMostInset = 0.35;  // of the length
    const auto score = [&](const Eigen::VectorXd& v, Feet feet) {
      if (v[6] < 0.0 || v[6] > kMostInset * v[4]) return kImpossible;
      const double post_m = 0.5 * v[4] - v[6];
      return BarOnPosts(v, 0.6, {-post_m, post_m}, feet);
    };
    const double lever_m = handle_.values[kHandleLength], long_m = std::max(lever_m, largest_m);
    std::vector<Eigen::VectorXd> starts = {With(BarLike(middle, lever_m), 0.0),
                                           With(BarLike(middle, long_m), 0.2 * long_m)};
    if (long_m > lever_m) starts.push_back(With(BarLike(middle, long_m), 0.0));
    return BestOnFeet(starts, With(BarSteps(), 0.012), score);
  }

  /// A bar on one post in its middle, or as near to it that it is no lever.
  double BestBarOnPost(const std::vector<Eigen::Vector2d>& middles) const {
    constexpr double kMostAside = 0.05;  // of the length; beyond, one end is a lever
    const auto score = [&](const Eigen::VectorXd& v, Feet feet) {
      if (std::abs(v[6]) > kMostAside * v[4] + v[5]) return kImpossible;
      return BarOnPosts(v, 0.4, {v[6]}, feet);
    };
    const double bar_m = handle_.values[kHandleLength] + handle_.values[kHandleBehind];
    std::vector<Eigen::VectorXd> starts;
    for (const Eigen::Vector2d& middle : middles)
      starts.push_back(With(BarLike(middle, bar_m), 0.0));
    return BestOnFeet(starts, With(BarSteps(), 0.006), score);
  }

  /// A rod bent from foot to foot: middle, turn, height, length, radius.
  /// @param seen the middle of what is seen along the handle's lever
  double BestBow(const Eigen::Vector2d& seen, double largest_m) const {
    constexpr int kPieces = 6;
    constexpr double kLowEnds_m = 0.03;  // too near to the door to be seen before it
    const auto score = [&](const Eigen::VectorXd& v) {
      if (v[3] < 0.02 || v[3] > 0.10 || v[4] < 0.05 || v[4] > 0.4 || v[5] < 0.003 || v[5] > 0.018)
        return kImpossible;
      const auto at = [&](int i) {
        const double angle = std::numbers::pi * i / kPieces;
        return Eigen::Vector3d(0.5 * v[4] * std::cos(angle), 0.0,
                               v[3] * std::sqrt(std::max(0.0, std::sin(angle))));
      };
      std::vector<HandleBar> bars;
      for (int i = 0; i < kPieces; ++i) bars.push_back({at(i), at(i + 1), v[5]});
      return Score(bars, {}, {v.head<2>(), 0.0, v[2]});
    };
    const HandleStep& h = handle_.values;
    std::vector<Eigen::VectorXd> starts;
    const Eigen::Vector2d way(std::cos(h[kHandleTurn]), std::sin(h[kHandleTurn]));
    const double bar_m = h[kHandleLength] + h[kHandleBehind];
    const Eigen::Vector2d middle = h.head<2>() + 0.5 * (h[kHandleLength] - h[kHandleBehind]) * way;
    const auto start_at = [&](const Eigen::Vector2d& at, double length_m) {
      Eigen::VectorXd start = BarLike(at, length_m);
      start[5] *= 0.7;
      starts.push_back(start);
    };
    start_at(seen, 1.3 * h[kHandleLength]);
    start_at(seen, largest_m + kLowEnds_m);
    // The pivot is one of its feet, and its other end is low over the door.
    start_at(middle + 0.25 * kLowEnds_m * way, bar_m + kLowEnds_m);
    Eigen::VectorXd steps(6);
    steps << 0.010, 0.010, 0.12, 0.008, 0.020, 0.003;
    return BestOf(starts, steps, score);
  }

  /// A box on the door: middle, turn, length, height, how far it stands out.
  double BestBox(const Eigen::Vector2d& middle, double largest_m) const {
    const auto score = [&](const Eigen::VectorXd& v) {
      if (v.tail<3>().minCoeff() < 0.006 || v.tail<3>().maxCoeff() > 0.6 || v[5] > 0.15)
        return kImpossible;
      return ScoreOfBox(v.tail<3>(), {v.head<2>(), 0.5 * v[5], v[2]});
    };
    const HandleStep& h = handle_.values;
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

 private:
  Rigid<frame::Base, frame::Object> PoseOf(const OnTheDoor& place) const {
    return base_from_door_ *
           Rigid<frame::Object, frame::Object>(
               Eigen::Quaterniond(Eigen::AngleAxisd(place.turn_rad, Eigen::Vector3d::UnitZ())),
               {place.at.x(), place.at.y(), place.off_m});
  }

  /// The handle's long plate, in the frame of a thing; none where it is on a rosette.
  std::vector<DoorThing::Plate> StripFor(const OnTheDoor& place) const {
    if (handle_.plate != HandleModel::Plate::kLong) return {};
    const HandleStep& h = handle_.values;
    DoorThing::Plate strip = PlateOf(HandleModel::Plate::kLong, place.off_m);
    strip.at = Eigen::Rotation2Dd(-place.turn_rad) * (h.head<2>() - place.at);
    strip.turn_rad = h[kHandleTurn] - place.turn_rad;
    return {strip};
  }

  /// Log likelihood of bars and plates, and of the handle's long plate with them.
  double Score(const std::vector<HandleBar>& bars, std::vector<DoorThing::Plate> plates,
               const OnTheDoor& place) const {
    for (DoorThing::Plate& strip : StripFor(place)) plates.push_back(std::move(strip));
    return LogLikelihoodOf(DoorThing(bars, std::move(plates), PoseOf(place)), likelihood_);
  }

  double ScoreOfBox(const Eigen::Vector3d& size_m, const OnTheDoor& place) const {
    const auto pose = PoseOf(place);
    std::vector<SolidPart> parts = DoorThing({}, StripFor(place), pose).Parts();
    SolidPart box;
    box.shape = SolidPart::Shape::kBox;
    box.size_m = size_m;
    parts.push_back(std::move(box));
    return OfImage(parts, pose, likelihood_.rays()).nats +
           likelihood_(CoverAllBy(SolidTracer(parts, pose)));
  }

  /// Of a bar (middle, turn, height, length, radius) on posts along it.
  double BarOnPosts(const Eigen::VectorXd& v, double most_length_m,
                    std::initializer_list<double> posts_m, Feet feet) const {
    if (v[3] < 0.02 || v[3] > 0.10 || v[4] < 0.05 || v[4] > most_length_m || v[5] < 0.004 ||
        v[5] > 0.022)
      return kImpossible;
    const Eigen::Vector3d end(0.5 * v[4], 0.0, 0.0);
    std::vector<HandleBar> bars = {{-end, end, v[5]}};
    std::vector<DoorThing::Plate> plates;
    for (const double post_m : posts_m) {
      bars.push_back({{post_m, 0.0, 0.0}, {post_m, 0.0, -v[3]}, v[5]});
      if (feet == Feet::kRosettes) plates.push_back(RosetteAt(post_m, v[3]));
    }
    return Score(bars, std::move(plates), {v.head<2>(), v[3], v[2]});
  }

  /// The best bar on bare posts and, where the image can tell, that on rosettes: beams hardly see
  /// whether there is one under the end of a lever.
  double BestOnFeet(const std::vector<Eigen::VectorXd>& starts, const Eigen::VectorXd& steps,
                    const ScoreOnFeet& score) const {
    constexpr int kRoundsOnRosettes = 3;
    const auto on = [&](Feet feet) {
      return [&score, feet](const Eigen::VectorXd& v) { return score(v, feet); };
    };
    const PatternSearchResult bare = BestThing(starts, steps, on(Feet::kBare));
    if (!likelihood_.rays().image || !std::isfinite(bare.score)) return bare.score;
    const PatternSearchResult rosettes =
        BestThing({bare.values}, 0.5 * steps, on(Feet::kRosettes), kRoundsOnRosettes);
    return std::max(bare.score, rosettes.score);
  }

  /// Where a bar is looked for first, as the handle's lever is.
  Eigen::VectorXd BarLike(const Eigen::Vector2d& middle, double length_m) const {
    const HandleStep& h = handle_.values;
    Eigen::VectorXd bar(6);
    bar << middle.x(), middle.y(), h[kHandleTurn], h[kHandleStandoff], length_m, h[kHandleRadius];
    return bar;
  }

  static Eigen::VectorXd BarSteps() {
    Eigen::VectorXd steps(6);
    steps << 0.010, 0.010, 0.12, 0.008, 0.016, 0.003;
    return steps;
  }

  const BeamLikelihood& likelihood_;
  const DoorFrame& base_from_door_;
  const HandleState& handle_;
};

}  // namespace

std::vector<HandleAlternative> FitHandleAlternatives(
    const BeamLikelihood& likelihood, const DoorFrame& base_from_door, const HandleState& handle,
    const std::vector<Eigen::Vector3d>& before_door, const RunContext& context) {
  const HandleStep& h = handle.values;
  const Eigen::Vector2d way(std::cos(h[kHandleTurn]), std::sin(h[kHandleTurn]));
  const Eigen::Vector2d pivot = h.head<2>();
  const Eigen::Vector2d middle = pivot + 0.5 * (h[kHandleLength] - h[kHandleBehind]) * way;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double low = 1e9, high = -1e9;
  for (const Eigen::Vector3d& point : before_door) {
    mean += point.head<2>() / static_cast<double>(before_door.size());
    // A lock or a cable beside it is no end of a bar.
    const Eigen::Vector2d from = point.head<2>() - pivot;
    if (std::abs(way.x() * from.y() - way.y() * from.x()) > kBesideLever_m) continue;
    low = std::min(low, way.dot(point.head<2>()));
    high = std::max(high, way.dot(point.head<2>()));
  }
  if (!(low < high)) {
    low = way.dot(pivot) - h[kHandleBehind];
    high = way.dot(pivot) + h[kHandleLength];
  }
  const Eigen::Vector2d seen = pivot + (0.5 * (low + high) - way.dot(pivot)) * way;
  const double largest_m = high - low;
  const OtherThings things(likelihood, base_from_door, handle);
  std::array<double, 7> best{};
  const std::function<double()> climbs[best.size()] = {
      [&] {
        return things.BestKnob({pivot, middle, mean});
      },
      [&] { return things.BestPullBar(middle, 0.0); },
      [&] { return things.BestPullBar(seen, largest_m); },
      [&] { return things.BestBow(seen, largest_m); },
      [&] {
        return things.BestBarOnPost({middle, seen});
      },
      [&] { return things.BestBox(middle, h[kHandleLength]); },
      [&] { return things.BestBox(seen, largest_m); }};
  ParallelFor(static_cast<int>(best.size()), context,
              [&](int i) { best[static_cast<std::size_t>(i)] = climbs[i](); });
  return {{"knob", 4, best[0]},
          {"pull bar", 7, std::max(best[1], best[2])},
          {"bow", 6, best[3]},
          {"bar on a post", 7, best[4]},
          {"box", 6, std::max(best[5], best[6])}};
}

}  // namespace foresight
