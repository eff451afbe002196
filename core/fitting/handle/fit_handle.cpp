#include "core/fitting/handle/fit_handle.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/fitting/gate.h"
#include "core/fitting/handle/door_normal.h"
#include "core/fitting/handle/door_surface.h"
#include "core/fitting/handle/handle_alternatives.h"
#include "core/fitting/handle/handle_search.h"
#include "core/fitting/handle/handle_verdict.h"
#include "core/fitting/handle/lever_way.h"
#include "core/fitting/ray_selection.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr int kMinRays = 60;
constexpr std::size_t kMinBefore = 6;
constexpr int kCoarseRays = 350;
// Which way a lever points, by logistic regression on training levers (docs/evaluation/handle.md,
// "Levers that bend"): what a deviation over lines of the beams is worth, and a nat of the image,
// whose nats may be many for the wrong way, too.
constexpr double kNatsPerDeviation = 1.25;
constexpr double kNatsOfImage = 0.3, kMostOfImage_nats = 4.5;
constexpr std::size_t kFine = 3;
constexpr double kSamePivot_m = 0.040;  // of two levers on one bar
constexpr double kLeastBefore_m = 0.020, kMostBefore_m = 0.110;
constexpr double kBeforeSigmas = 1.5;
constexpr int kFootprintSamples = 3;
// Of a bar's height over its door, in proportion to the range as footprints are: what training
// scenes lack in their median, at home and under varied conditions together.
constexpr double kMapLacks = 0.009, kBeamsLack = 0.004;
constexpr double kMostOff_m = 0.016, kOffStep_m = 0.001;  // beams against their map
constexpr double kOtherLength_m = 0.020;  // of the alternatives; what a hand would notice

/// Streams of the seed: each stage draws its own numbers.
enum Stream : std::uint64_t { kThinning, kDoor, kSearch };

tl::unexpected<Error> Cancelled() {
  return Fail(ErrorCode::kCancelled, "fitting the door handle was cancelled");
}

BeamOptions HandleBeams() {
  BeamOptions options;
  options.early_return = 0.0;
  options.samples = kFootprintSamples;
  options.mixed_ranges = true;
  return options;
}

void SortBest(std::vector<HandleState>& states) {
  std::stable_sort(states.begin(), states.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
}

Eigen::Vector3d MeanOf(const RaySet& rays) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const RangeRay& ray : rays.rays) mean += ray.Point() / static_cast<double>(rays.rays.size());
  return mean;
}

/// The door first: footprints mix with that.
std::vector<Plane> PlanesOf(const DoorSurface& surface) {
  std::vector<Plane> planes = {surface.door};
  if (surface.beside) planes.push_back(*surface.beside);
  return planes;
}

/// A lever and the best one that points the other way.
struct TwoWays {
  HandleState best, mirrored;
  // How much each kind of evidence speaks for the best one.
  double beams_nats = 0.0;
  double edges_nats = 0.0;
  double image_nats = 0.0;

  double Ahead() const { return beams_nats + edges_nats + image_nats; }
  TwoWays Swapped() const { return {mirrored, best, -beams_nats, -edges_nats, -image_nats}; }
};

/// One handle's fit on one door while it lasts.
class HandleFit {
 public:
  HandleFit(const RaySet& region, const RaySet& rays, const DoorSurface& surface,
            const FitHandleOptions& options)
      : region_(region),
        options_(options),
        door_(surface.door),
        base_from_door_(DoorFrameOf(surface.door, MeanOf(rays))),
        likelihood_(rays, PlanesOf(surface), HandleBeams()) {
    const auto door_from_base = base_from_door_.Inverse();
    const double least_m = std::max(kLeastBefore_m, kBeforeSigmas * region.sigma_m);
    for (const RangeRay& ray : region.rays) {
      const Eigen::Vector3d at = door_from_base * ray.Point();
      if (at.z() > least_m && at.z() < kMostBefore_m) before_door_.push_back(at);
    }
  }

  const DoorFrame& base_from_door() const { return base_from_door_; }

  /// The best levers of the region, looked for by a few of its rays first.
  Result<TwoWays> Search(const RaySet& few_rays, Random& random, const RunContext& context) const {
    if (before_door_.size() < kMinBefore)
      return Fail(ErrorCode::kNoConvergence,
                  "only {} measurements lie 20 to 110 mm before the door: draw the region around "
                  "the handle, or scan slower",
                  before_door_.size());
    const HandleScorer fine{likelihood_, base_from_door_, options_};
    const BeamLikelihood few(few_rays, std::vector<Plane>{door_}, HandleBeams());
    const HandleScorer coarse{few, base_from_door_, options_};
    const BeamLikelihood few_beams(WithoutImage(few_rays), std::vector<Plane>{door_},
                                   HandleBeams());
    context.Report(0.1, "looking for bars");
    std::vector<HandleState> levers =
        FindLevers({few_beams, base_from_door_, options_}, before_door_, random, context);
    if (context.Cancelled()) return Cancelled();
    if (levers.empty())
      return Fail(ErrorCode::kNoConvergence,
                  "no lever of {:.0f} to {:.0f} mm stands before the door: draw the region around "
                  "the handle",
                  1000.0 * options_.min_length_m, 1000.0 * options_.max_length_m);
    context.Report(0.3, "improving the pose");
    FORESIGHT_CHECK(SearchAll(coarse, HandleEffort::kCoarse, levers, context));
    if (levers.size() > kFine) levers.resize(kFine);
    // The dangerous error is a lever that points the other way on the same bar: that one is tried
    // with equal care.
    levers.push_back(Mirrored(levers.front()));
    FORESIGHT_CHECK(SearchAll(fine, HandleEffort::kFine, levers, context));
    TwoWays found{levers.front(), {}};
    const HandleState turned = Mirrored(found.best);
    const auto is_turned = [&](const HandleState& lever) {
      return PointsTheOtherWay(lever, found.best) &&
             (lever.values - turned.values).head<2>().norm() < kSamePivot_m;
    };
    const auto same_bar = std::find_if(levers.begin(), levers.end(), is_turned);
    found.mirrored =
        same_bar != levers.end() ? *same_bar : LocalSearch(fine, turned, HandleEffort::kFine);
    if (found.mirrored.score > found.best.score) std::swap(found.best, found.mirrored);
    return found;
  }

  /// The levers of another door's search on this one.
  Result<TwoWays> SearchFrom(const TwoWays& found, const DoorFrame& base_from_other,
                             const RunContext& context) const {
    const HandleScorer fine{likelihood_, base_from_door_, options_};
    std::vector<HandleState> levers = {OnDoor(found.best, base_from_other, base_from_door_),
                                       OnDoor(found.mirrored, base_from_other, base_from_door_)};
    FORESIGHT_CHECK(SearchAll(fine, HandleEffort::kFinest, levers, context));
    return TwoWays{levers.front(), levers.back()};
  }

  /// The way that beams and the door's edges speak for together. Beams of a line err together: by
  /// their number some would be sure of the wrong way.
  /// @param around null = not known
  TwoWays Weighed(TwoWays found, const RaySet* around) const {
    const double ahead =
        likelihood_.DeviationsAhead(CoverBy(ThingOf(found.best)), CoverBy(ThingOf(found.mirrored)));
    found.beams_nats =
        kNatsPerDeviation * (likelihood_.rays().image ? ahead : std::max(0.0, ahead));
    found.image_nats =
        std::clamp(kNatsOfImage * (OutlineOf(found.best).nats - OutlineOf(found.mirrored).nats),
                   -kMostOfImage_nats, kMostOfImage_nats);
    if (around != nullptr)
      found.edges_nats = EdgesForWay(*around, door_, CandidateOf(found.best, base_from_door_));
    return found.Ahead() < 0.0 ? found.Swapped() : found;
  }

  Result<HandleDetection> Fit(const TwoWays& found, const RunContext& context) const {
    if (!(found.best.score > likelihood_.Nothing()))
      return Fail(ErrorCode::kNoConvergence,
                  "nothing before the door looks like a handle: draw the region around one, or "
                  "scan slower");
    if (context.Cancelled()) return Cancelled();
    context.Report(0.7, "trying other shapes");
    return DetectionOf(found, context);
  }

 private:
  DoorThing ThingOf(const HandleState& state) const {
    return foresight::ThingOf(state.Model(), state.Pose(base_from_door_));
  }

  /// What the image says of the lever, on the plate and with the end that lie best on its edges:
  /// beams take a rosette and the lock below it for a long plate, and that must not speak against
  /// the way that the lever points.
  OutlineSupport OutlineOf(const HandleState& lever) const {
    std::optional<OutlineSupport> best;
    for (const HandleState& variant : VariantsOf(lever))
      if (const auto support = OfImage(ThingOf(variant), likelihood_.rays());
          !best || support.nats > best->nats)
        best = support;
    return *best;
  }

  static bool PointsTheOtherWay(const HandleState& a, const HandleState& b) {
    return std::cos(a.values[kHandleTurn] - b.values[kHandleTurn]) < 0.0;
  }

  static Status SearchAll(const HandleScorer& scorer, HandleEffort effort,
                          std::vector<HandleState>& states, const RunContext& context) {
    const auto climb = [&](int i) {
      HandleState& state = states[static_cast<std::size_t>(i)];
      state = LocalSearch(scorer, state, effort);
    };
    if (!ParallelFor(static_cast<int>(states.size()), context, climb)) return Cancelled();
    SortBest(states);
    return {};
  }

  /// What the standoff that was found lacks. A bar that is narrower than a footprint is drawn to
  /// its door, and a map smooths it into the door: the beams behind the map know it better, and
  /// what beams and maps lack is known.
  double StandoffLacking(const HandleState& lever) const {
    const bool map_alone = likelihood_.rays().dense && likelihood_.BehindMap() == nullptr;
    const HandleState found = likelihood_.BehindMap() ? WithStandoffOfBeams(lever) : lever;
    const Eigen::Vector3d pivot = lever.Pose(base_from_door_).translation();
    const double range_m = (pivot - likelihood_.rays().viewpoint).norm();
    return found.values[kHandleStandoff] - lever.values[kHandleStandoff] +
           range_m * (map_alone ? kMapLacks : kBeamsLack);
  }

  /// The same lever, that much further off the door on the line on which it is seen.
  HandleState Nearer(HandleState lever, double off_m) const {
    const Eigen::Vector3d viewpoint = base_from_door_.Inverse() * likelihood_.rays().viewpoint;
    lever.values.head<2>() += off_m * AlongSight(lever, viewpoint);
    lever.values[kHandleStandoff] += off_m;
    return lever;
  }

  /// An answer, `by_m` further off the door than the rays had it.
  HandleCandidate Placed(const HandleState& lever, double by_m) const {
    return CandidateOf(Nearer(lever, by_m), base_from_door_);
  }

  /// As far off the door as the beams behind the map say; the score stays the map's.
  HandleState WithStandoffOfBeams(const HandleState& lever) const {
    HandleState best = lever;
    const HandleScorer beams{*likelihood_.BehindMap(), base_from_door_, options_};
    double best_score = beams(best);
    for (double off_m = -kMostOff_m; off_m <= kMostOff_m; off_m += kOffStep_m) {
      const HandleState tried = Nearer(lever, off_m);
      const double score = beams(tried);
      if (!(score > best_score)) continue;
      best_score = score;
      best = tried;
    }
    return best;
  }

  Result<HandleDetection> DetectionOf(const TwoWays& found, const RunContext& context) const {
    const HandleState &best = found.best, &mirrored = found.mirrored;
    HandleDetection detection;
    detection.best = CandidateOf(best, base_from_door_);
    detection.door = door_;
    const HandleScorer scorer{likelihood_, base_from_door_, options_};
    std::vector<HandleAlternative> alternatives;
    HandleState shorter, longer;
    const std::function<void()> independent[] = {
        [&] {
          alternatives =
              FitHandleAlternatives(likelihood_, base_from_door_, best, before_door_, context);
        },
        [&] { shorter = OtherLength(scorer, best, -kOtherLength_m); },
        [&] { longer = OtherLength(scorer, best, kOtherLength_m); },
        [&] { SetSigmas(scorer, best, detection); }};
    if (!ParallelFor(std::size(independent), context, [&](int i) { independent[i](); }))
      return Cancelled();
    std::vector<HandleState> others = {mirrored};
    others.front().score = best.score - found.Ahead();
    // Where the options allow no other length none is near.
    double best_length = best.score - kFarBehind_nats;
    bool tried = false;
    for (const HandleState& other : {shorter, longer}) {
      if (!std::isfinite(other.score)) continue;
      others.push_back(other);
      best_length = tried ? std::max(best_length, other.score) : other.score;
      tried = true;
    }
    SortBest(others);
    const double lacking_m = StandoffLacking(best);
    for (const HandleState& other : others)
      detection.alternatives.push_back(Placed(other, lacking_m));
    HandleEvidence& evidence = detection.evidence;
    // The margins compare answers to the same rays; the place is told by those that know it best.
    const HandleCandidate placed = Placed(best, lacking_m);
    evidence = GatherEvidence(likelihood_, door_, placed);
    const double own = LogLikelihoodOf(ThingOf(best), likelihood_);
    evidence.mirror_margin_nats = found.Ahead();
    evidence.edges_nats = found.edges_nats;
    evidence.image_nats = found.image_nats;
    evidence.outline_nats_per_px = OutlineOf(best).NatsPerPixel();
    evidence.length_margin_nats = best.score - best_length;
    evidence.gain_nats = own - likelihood_.Nothing();
    evidence.alternative_margin_nats = std::numeric_limits<double>::infinity();
    // Half of Schwarz's penalty for each parameter that an alternative has more.
    const double measurements = std::max(2.0, evidence.hits * region_.Measured().samples_per_ray);
    for (const HandleAlternative& alternative : alternatives) {
      const double margin =
          own - alternative.log_likelihood +
          0.5 * (alternative.parameters - kFreeHandleParameters) * std::log(measurements);
      if (!(margin < evidence.alternative_margin_nats)) continue;
      evidence.alternative_margin_nats = margin;
      evidence.best_alternative = alternative.name;
    }
    detection.verdict = AssessHandle(likelihood_.rays(), detection, options_, best.score - own);
    detection.best = placed;
    return detection;
  }

  const RaySet& region_;
  const FitHandleOptions& options_;
  Plane door_;
  DoorFrame base_from_door_;
  BeamLikelihood likelihood_;
  std::vector<Eigen::Vector3d> before_door_;  ///< in the door's frame
};

}  // namespace

Status FitHandleOptions::Check() const {
  if (!(min_length_m >= 0.02 && min_length_m < max_length_m && max_length_m < 1.0))
    return Fail(ErrorCode::kInvalidOptions,
                "door handle fit: lengths of {} to {} m; 0.02 to 1, the least first", min_length_m,
                max_length_m);
  if (pair_trials < 1)
    return Fail(ErrorCode::kInvalidOptions, "door handle fit: pair_trials {} is below 1",
                pair_trials);
  if (max_rays < kMinRays)
    return Fail(ErrorCode::kInvalidOptions, "door handle fit: max_rays {} is below {}", max_rays,
                kMinRays);
  return {};
}

Result<HandleDetection> FitHandle(const RaySet& all_rays, const FitHandleOptions& options,
                                  const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(const RaySet region, UsableRays(all_rays, kMinRays, "a door handle"));
  context.Report(0.0, "looking for the door");
  Random thinning(options.seed, kThinning), door_random(options.seed, kDoor),
      random(options.seed, kSearch);
  RaySet rays = Thinned(region, options.max_rays, thinning);
  const WallSplit split = SplitWall(rays, door_random);
  if (!split.wall)
    return Fail(ErrorCode::kNoConvergence,
                "no door is seen in the region: draw it a little larger around the handle");
  const RaySet* around = SurroundingBeams(region);
  const Plane door = around != nullptr
                         ? DoorAmongLevels(*around, region.Measured(), *split.wall, door_random)
                         : *split.wall;
  RaySet few_rays = Thinned(rays, kCoarseRays, thinning);
  few_rays.beams = nullptr;
  rays.beams = ThinnedBeams(region, options.max_rays, kMinRays, thinning);
  const HandleFit first(region, rays, {.door = door}, options);
  FORESIGHT_TRY(TwoWays levers, first.Search(few_rays, random, context));
  context.Report(0.6, "looking at the door again");
  const DoorSurface surface =
      DoorRound(rays, door, around != nullptr, CandidateOf(levers.best, first.base_from_door()));
  const HandleFit fit(region, rays, surface, options);
  FORESIGHT_TRY(levers, fit.SearchFrom(levers, first.base_from_door(), context));
  levers = fit.Weighed(levers, around);
  FORESIGHT_TRY(HandleDetection detection, fit.Fit(levers, context));
  detection.origin.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  context.Report(1.0, "door handle fitted");
  return detection;
}

}  // namespace foresight
