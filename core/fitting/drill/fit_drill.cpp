#include "core/fitting/drill/fit_drill.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/fitting/beam_likelihood.h"
#include "core/fitting/drill/alternative_shapes.h"
#include "core/fitting/drill/drill_covariance.h"
#include "core/fitting/drill/drill_search.h"
#include "core/fitting/drill/drill_state.h"
#include "core/fitting/drill/drill_verdict.h"
#include "core/fitting/drill/named_part.h"
#include "core/fitting/drill/other_tools.h"
#include "core/fitting/drill/support_and_background.h"
#include "core/fitting/ray_selection.h"
#include "core/fitting/region_place.h"
#include "core/fitting/solids/solid_coverage.h"
#include "core/fitting/solids/solid_tracer.h"

namespace foresight {
namespace {

constexpr int kMinRays = 60;
constexpr std::size_t kMinForeground = 25;
constexpr int kCoarseRays = 500;
constexpr std::size_t kCoarseModes = 10;
constexpr std::size_t kFineModes = 4;
constexpr std::size_t kFineAlternatives = 2;  // of other templates in the leader's place
constexpr std::size_t kAlternatives = 3;
constexpr double kBodyRadius_m = 0.027;
constexpr double kOtherWay_rad = 0.5;
constexpr double kOwnReach_m = 0.04;  // of the points that a drill or its alternatives account for
constexpr double kAlternativeReach_m =
    0.06;  // round the drill: what an alternative must explain too
// What a proportion costs that is known about three times better after the fit than before.
constexpr double kKnownProportion_nats = 1.0;
constexpr double kNozzle_m = 0.072;        // longer than any chuck
constexpr double kUnknownHeight_m = 0.04;  // deviation of a foot's height without a table

/// Streams of the seed: each stage draws its own numbers.
enum Stream : std::uint64_t { kThinning, kSupportAndBackground };

Status CheckForeground(const RaySet& rays, const SupportAndBackground& found) {
  if (found.foreground.size() >= kMinForeground) return {};
  return Fail(ErrorCode::kNoConvergence,
              "only {} of {} measurements stand on the table before the wall: draw the region "
              "around the drill",
              found.foreground.size(), rays.rays.size());
}

/// The lowest that anything in the foreground reaches, as a level plane: where a foot would be.
Plane GuessedTable(const std::vector<Eigen::Vector3d>& foreground, const Eigen::Vector3d& up) {
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : foreground) heights.push_back(up.dot(point));
  return {up, MoveToRank(heights, heights.size() / 50)};
}

Eigen::Vector3d Mean(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

void SortBest(std::vector<DrillState>& states) {
  std::stable_sort(states.begin(), states.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
}

/// One drill's fit while it lasts.
class DrillFit {
 public:
  DrillFit(const RaySet& region, const RaySet& rays, RaySet few_rays,
           const SupportAndBackground& around, const FitDrillOptions& options)
      : region_(region),
        options_(options),
        around_(around),
        likelihood_(rays, around.planes, kDrillBeams),
        coarse_(few_rays, around.planes, kDrillBeams),
        coarse_beams_(WithoutImage(std::move(few_rays)), around.planes, kDrillBeams),
        table_(around.table ? *around.table : GuessedTable(around.foreground, options.up)),
        base_from_table_(FrameOf(table_, Mean(around.foreground))) {
    prior_.max_tilt_rad = options.max_body_tilt_rad;
    if (!around.table) prior_.height_sigma_m = kUnknownHeight_m;
  }

  /// Modes of all templates after local search, best first.
  Result<std::vector<DrillState>> Search(const RunContext& context) const {
    context.Report(0.2, "looking for the body");
    std::vector<Eigen::Vector3d> central = around_.foreground;
    std::erase_if(central, [&](const Eigen::Vector3d& point) {
      return DistanceFromRegionCenter(likelihood_.rays(), point) > kMaxOffCenter_m;
    });
    const auto bodies = FindBodies(coarse_beams_, central, base_from_table_, kBodyRadius_m);
    if (bodies.empty())
      return Fail(ErrorCode::kNoConvergence,
                  "nothing as tall as a drill stands in the region: draw it around the drill");
    context.Report(0.3, "turning the templates");
    FORESIGHT_TRY(
        std::vector<DrillState> modes,
        FindModes(coarse_beams_, options_.templates, bodies, base_from_table_, prior_, context));
    if (modes.empty())
      return Fail(ErrorCode::kNoConvergence,
                  "no template of a drill can be compared with the region: draw it around the "
                  "drill");
    context.Report(0.5, "improving the pose");
    FORESIGHT_CHECK(
        LocalSearchOfAll(coarse_, modes, kCoarseModes, LocalSearchEffort::kCoarse, context));
    DropDuplicates(modes);
    FORESIGHT_CHECK(
        LocalSearchOfAll(likelihood_, modes, kFineModes, LocalSearchEffort::kFine, context));
    return modes;
  }

  /// The dangerous error is a drill that points the wrong way. The leader is turned by 180 deg, and
  /// every other template stands in its place either way round, for as long as one of these is
  /// better: a search that began with one template may have missed the other way of another. Those
  /// that were not better join the modes; the best one that points the other way is returned.
  Result<DrillState> TestFlip(std::vector<DrillState>& modes, const RunContext& context) const {
    constexpr int kMostTurns = 4;
    for (int i = 0; i < kMostTurns; ++i) {
      const DrillState leader = modes.front();
      std::vector<DrillState> alternatives;
      for (const DrillTemplate& kind : options_.templates) {
        if (&kind == leader.kind) continue;
        for (const DrillState& way : {leader, Flipped(leader, prior_)})
          alternatives.push_back(OfKind(coarse_, kind, way, base_from_table_, prior_));
      }
      FORESIGHT_CHECK(LocalSearchOfAll(coarse_, alternatives, alternatives.size(),
                                       LocalSearchEffort::kCoarse, context));
      if (alternatives.size() > kFineAlternatives) alternatives.resize(kFineAlternatives);
      alternatives.push_back(Flipped(leader, prior_));
      FORESIGHT_CHECK(LocalSearchOfAll(likelihood_, alternatives, alternatives.size(),
                                       LocalSearchEffort::kFine, context));
      modes.insert(modes.end(), alternatives.begin(), alternatives.end());
      SortBest(modes);
      if (!(modes.front().log_likelihood > leader.log_likelihood)) break;
    }
    for (const DrillState& mode : modes)
      if (TurnBetween(mode.yaw(), modes.front().yaw()) > 0.5 * std::numbers::pi) return mode;
    return Flipped(modes.front(), prior_);
  }

  Result<DrillDetection> Detection(std::vector<DrillState> modes, const RunContext& context) const {
    FORESIGHT_TRY(const DrillState flipped, TestFlip(modes, context));
    const DrillState& best = modes.front();
    DrillDetection detection;
    detection.best = CandidateOf(best, base_from_table_);
    detection.table = around_.table;
    for (const DrillState& mode : OtherPlaces(modes))
      detection.alternatives.push_back(CandidateOf(mode, base_from_table_));
    DrillSupport support;
    detection.evidence = GatherEvidence(likelihood_.rays(), detection.best);
    SetMargins(modes, flipped.log_likelihood, detection);
    support.proportions_nats = prior_(best);
    DrillState any_flipped, any_own_way;
    std::optional<double> without_foot, without_chuck;
    const std::function<void()> independent[] = {
        [&] { any_flipped = OfAnyProportions(flipped); },
        [&] { any_own_way = OfAnyProportions(best); },
        [&] { without_foot = LikelihoodOfTool(WithoutFoot(*best.kind), best); },
        [&] { without_chuck = LikelihoodOfTool(WithoutChuck(*best.kind), best); },
        [&] { SetAlternativeMargin(best, detection); },
        [&] {
          support.beam_sigma_yaw_rad =
              SetSigmas(likelihood_.rays(), best, base_from_table_, prior_, detection);
          SetChuckMargins(best, detection, support);
          support.foot_nats = FootNats(best, detection);
          detection.evidence.nozzle_margin_nats = NozzleMargin(best, detection);
        }};
    if (!ParallelFor(std::size(independent), context, [&](int i) { independent[i](); }))
      return Cancelled();
    const double own_way = WithoutPrior(any_own_way);
    SetFlipOfAnyProportions(best, any_flipped, own_way, detection, support);
    const double usual = best.log_likelihood - prior_(best), own = std::max(usual, own_way);
    DrillEvidence& evidence = detection.evidence;
    evidence.unusual_nats = own_way - usual;
    if (without_foot) evidence.no_foot_margin_nats = own - *without_foot;
    if (without_chuck) evidence.no_chuck_margin_nats = own - *without_chuck;
    detection.verdict = AssessDrill(likelihood_.rays(), region_, detection, best, prior_, support);
    return detection;
  }

  double Nothing() const { return likelihood_.Nothing(); }

 private:
  static tl::unexpected<Error> Cancelled() {
    return Fail(ErrorCode::kCancelled, "fitting the drill was cancelled");
  }

  Status LocalSearchOfAll(const BeamLikelihood& likelihood, std::vector<DrillState>& states,
                          std::size_t count, LocalSearchEffort effort,
                          const RunContext& context) const {
    if (states.size() > count) states.resize(count);
    const auto climb = [&](int i) {
      DrillState& state = states[static_cast<std::size_t>(i)];
      state = LocalSearch(likelihood, state, base_from_table_, prior_, effort);
    };
    if (!ParallelFor(static_cast<int>(states.size()), context, climb)) return Cancelled();
    SortBest(states);
    return {};
  }

  static bool SamePlace(const DrillState& a, const DrillState& b) {
    return TurnBetween(a.yaw(), b.yaw()) < 0.2 &&
           (a.values.head<2>() - b.values.head<2>()).norm() < 0.02;
  }

  /// Of modes of one template that climbed to the same place the best stays.
  static void DropDuplicates(std::vector<DrillState>& modes) {
    std::vector<DrillState> kept;
    for (const DrillState& mode : modes)
      if (std::none_of(kept.begin(), kept.end(), [&](const DrillState& other) {
            return other.kind == mode.kind && SamePlace(other, mode);
          }))
        kept.push_back(mode);
    modes = std::move(kept);
  }

  /// What an operator is shown beside the first: the best that stand elsewhere or point elsewhere.
  static std::vector<DrillState> OtherPlaces(const std::vector<DrillState>& modes) {
    std::vector<DrillState> shown = {modes.front()};
    for (const DrillState& mode : modes)
      if (shown.size() <= kAlternatives &&
          std::none_of(shown.begin(), shown.end(),
                       [&](const DrillState& other) { return SamePlace(other, mode); }))
        shown.push_back(mode);
    shown.erase(shown.begin());
    return shown;
  }

  void SetMargins(const std::vector<DrillState>& modes, double flipped_log_likelihood,
                  DrillDetection& detection) const {
    const DrillState& best = modes.front();
    DrillEvidence& evidence = detection.evidence;
    double other_way = Nothing();
    for (const DrillState& mode : modes)
      if (TurnBetween(mode.yaw(), best.yaw()) > kOtherWay_rad)
        other_way = std::max(other_way, mode.log_likelihood);
    evidence.yaw_margin_nats = best.log_likelihood - other_way;
    evidence.flip_margin_nats = best.log_likelihood - flipped_log_likelihood;
    evidence.yaw_margin_nats = std::min(evidence.yaw_margin_nats, evidence.flip_margin_nats);
    evidence.gain_nats = best.log_likelihood - Nothing();
    std::vector<SolidPart> headless = detection.best.model.parts;
    std::erase_if(headless, [](const SolidPart& part) {
      return part.name != DrillTemplate::kBody && part.name != DrillTemplate::kFoot;
    });
    evidence.head_nats = best.log_likelihood - prior_(best) -
                         LogLikelihoodOf(headless, detection.best.base_from_object, likelihood_);
  }

  DrillState OfAnyProportions(const DrillState& state) const {
    return LocalSearch(likelihood_, state, base_from_table_, AnyProportions(prior_),
                       LocalSearchEffort::kFine);
  }

  double WithoutPrior(const DrillState& state) const {
    return LogLikelihoodOf(state.Model().parts, state.Pose(base_from_table_), likelihood_);
  }

  /// Log likelihood, without prior, of another tool where a drill stands, in the pose, size and
  /// proportions that suit the tool best: a tool that must be built as the drill is only behind it
  /// because it is not. The search starts from what is built alike or from the usual tool,
  /// whichever a few rays find better.
  std::optional<double> LikelihoodOfTool(const std::optional<DrillTemplate>& tool,
                                         const DrillState& drill) const {
    if (!tool) return std::nullopt;
    const DrillPrior any = AnyProportions(prior_);
    DrillState alike = drill;
    alike.kind = &*tool;
    // Without a bit its head ends where the drill's chuck does.
    alike.values[kDrillBit] = std::min(alike.values[kDrillBit], tool->max_bit_length_m);
    const auto climbed = [&](const DrillState& start) {
      return LocalSearch(coarse_, start, base_from_table_, any, LocalSearchEffort::kCoarse);
    };
    const DrillState near = climbed(alike);
    const DrillState usual = climbed(OfKind(coarse_, *tool, drill, base_from_table_, any));
    const DrillState& better = near.log_likelihood > usual.log_likelihood ? near : usual;
    return WithoutPrior(
        LocalSearch(likelihood_, better, base_from_table_, any, LocalSearchEffort::kFine));
  }

  /// No drill is its template, and a head that is longer behind than the template's is a drill that
  /// points the other way: the flipped one may take any proportions, at no cost.
  void SetFlipOfAnyProportions(const DrillState& best, const DrillState& flipped, double own_way,
                               const DrillDetection& detection, DrillSupport& support) const {
    const DrillModel model = flipped.Model();
    const auto pose = flipped.Pose(base_from_table_);
    const double turned = WithoutPrior(flipped);
    const double margin = best.log_likelihood - prior_(best) - turned;
    support.any_flip_margin_nats = std::min(margin, detection.evidence.flip_margin_nats);
    support.any_way_margin_nats = own_way - turned;
    support.outline =
        OfImage(detection.best.model.parts, detection.best.base_from_object, likelihood_.rays());
    support.image_flip_nats =
        support.outline.nats - OfImage(model.parts, pose, likelihood_.rays()).nats;
    support.flip_line_sigmas = likelihood_.DeviationsAhead(
        CoverBy(SolidTracer(detection.best.model.parts, detection.best.base_from_object)),
        CoverBy(SolidTracer(model.parts, pose)));
  }

  /// Whether it ends as drills do, in a chuck that is narrower than the head: lamps and blowers on
  /// a grip end as wide as they are.
  void SetChuckMargins(const DrillState& best, const DrillDetection& detection,
                       DrillSupport& support) const {
    const auto& pose = detection.best.base_from_object;
    const double own = best.log_likelihood - prior_(best);
    std::vector<SolidPart> blunt = detection.best.model.parts;
    const SolidPart* head = NamedPart(blunt, DrillTemplate::kHead);
    SolidPart* chuck = NamedPart(blunt, DrillTemplate::kChuck);
    if (head == nullptr || chuck == nullptr) return;
    chuck->size_m.head<2>().setConstant(head->size_m.y());
    support.blunt_margin_nats = own - LogLikelihoodOf(blunt, pose, likelihood_);
    std::erase_if(blunt, [](const SolidPart& part) { return part.name == DrillTemplate::kBit; });
    support.blunt_margin_nats =
        std::min(support.blunt_margin_nats, own - LogLikelihoodOf(blunt, pose, likelihood_));
    std::erase_if(blunt, [](const SolidPart& part) { return part.name == DrillTemplate::kChuck; });
    support.chuck_nats = own - LogLikelihoodOf(blunt, pose, likelihood_);
  }

  /// Whether it ends in a chuck, and not in the nozzle of a hot air or glue tool.
  std::optional<double> NozzleMargin(const DrillState& best,
                                     const DrillDetection& detection) const {
    const double own = best.log_likelihood - prior_(best);
    std::optional<double> margin;
    for (const auto& tool : WithNozzles(detection.best.model.parts, kNozzle_m)) {
      const double ahead =
          own - LogLikelihoodOf(tool, detection.best.base_from_object, likelihood_);
      margin = std::min(margin.value_or(ahead), ahead);
    }
    return margin;
  }

  /// Whether it stands on a battery: hot air tools on a grip stand on the end of the grip.
  double FootNats(const DrillState& best, const DrillDetection& detection) const {
    std::vector<SolidPart> parts = detection.best.model.parts;
    const SolidPart* body = NamedPart(parts, DrillTemplate::kBody);
    bool has_feet = false;
    for (SolidPart& part : parts) {
      if (part.name != DrillTemplate::kFoot) continue;
      has_feet = true;
      part.size_m.head<2>() = part.size_m.head<2>().cwiseMin(body->size_m.head<2>());
      part.object_from_part = {part.object_from_part.rotation(),
                               {0.0, 0.0, part.object_from_part.translation().z()}};
    }
    if (!has_feet) return std::numeric_limits<double>::infinity();
    return best.log_likelihood - prior_(best) -
           LogLikelihoodOf(parts, detection.best.base_from_object, likelihood_);
  }

  /// The foreground that a drill may account for, without the clutter beside it.
  std::vector<Eigen::Vector3d> ForegroundAt(const DrillCandidate& drill) const {
    const auto object_from_base = drill.base_from_object.Inverse();
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3d& point : around_.foreground) {
      const Eigen::Vector3d at = object_from_base * point;
      if (std::any_of(drill.model.parts.begin(), drill.model.parts.end(),
                      [&](const SolidPart& part) { return part.Distance(at) < kOwnReach_m; }))
        points.push_back(point);
    }
    return points;
  }

  /// Half of Schwarz's penalty for each parameter that an alternative has more than the drill. What
  /// drills of one kind differ in costs what its prior says instead, and that it was found.
  void SetAlternativeMargin(const DrillState& best, DrillDetection& detection) const {
    const auto& parts = detection.best.model.parts;
    const auto& pose = detection.best.base_from_object;
    const BeamLikelihood near(RaysNear(likelihood_.rays(), parts, pose, kAlternativeReach_m),
                              around_.planes, kDrillBeams);
    const double own = LogLikelihoodOf(parts, pose, near) + prior_(best) -
                       kKnownProportion_nats * (kDrillParameters - kDrillFreeParameters);
    const double measurements =
        std::max(2.0, static_cast<double>(near.rays().rays.size()) * near.rays().samples_per_ray);
    DrillEvidence& evidence = detection.evidence;
    evidence.alternative_margin_nats = own - near.Nothing();
    for (const AlternativeShape& alternative : FitAlternativeShapes(
             near, ForegroundAt(detection.best), base_from_table_, best.values.head<2>())) {
      const double margin =
          own - alternative.log_likelihood +
          0.5 * (alternative.parameters - kDrillFreeParameters) * std::log(measurements);
      if (!evidence.best_alternative.empty() && margin >= evidence.alternative_margin_nats)
        continue;
      evidence.alternative_margin_nats = margin;
      evidence.best_alternative = alternative.name;
    }
  }

  const RaySet& region_;
  const FitDrillOptions& options_;
  const SupportAndBackground& around_;
  BeamLikelihood likelihood_;
  BeamLikelihood coarse_;
  BeamLikelihood coarse_beams_;  ///< where thousands of places are tried
  Plane table_;
  TableFrame base_from_table_;
  DrillPrior prior_;
};

}  // namespace

Status FitDrillOptions::Check() const {
  if (templates.empty())
    return Fail(ErrorCode::kInvalidOptions, "drill fit: there are no templates");
  for (const DrillTemplate& kind : templates) FORESIGHT_CHECK(kind.Check());
  if (!(std::abs(up.norm() - 1.0) < 1e-6))
    return Fail(ErrorCode::kInvalidOptions, "drill fit: up has length {}, not 1", up.norm());
  if (!(max_table_tilt_rad > 0.0 && max_table_tilt_rad < 1.0))
    return Fail(ErrorCode::kInvalidOptions, "drill fit: max_table_tilt_rad {} is not within 0 to 1",
                max_table_tilt_rad);
  if (!(max_body_tilt_rad > 0.0 && max_body_tilt_rad < 1.0))
    return Fail(ErrorCode::kInvalidOptions, "drill fit: max_body_tilt_rad {} is not within 0 to 1",
                max_body_tilt_rad);
  if (max_rays < kMinRays)
    return Fail(ErrorCode::kInvalidOptions, "drill fit: max_rays {} is below {}", max_rays,
                kMinRays);
  return {};
}

Result<DrillDetection> FitDrill(const RaySet& all_rays, const FitDrillOptions& options,
                                const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(const RaySet usable, UsableRays(all_rays, kMinRays, "a drill"));

  context.Report(0.0, "looking for the table");
  Random thinning(options.seed, kThinning);
  Random random(options.seed, kSupportAndBackground);
  RaySet rays = Thinned(usable, options.max_rays, thinning);
  const SupportAndBackground around =
      FindSupportAndBackground(rays, {options.up, options.max_table_tilt_rad}, random);
  FORESIGHT_CHECK(CheckForeground(rays, around));
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "fitting the drill was cancelled");

  RaySet few_rays = Thinned(rays, kCoarseRays, thinning);
  few_rays.beams = nullptr;
  rays.beams = ThinnedBeams(usable, options.max_rays, kMinRays, thinning);
  const DrillFit fit(usable, rays, std::move(few_rays), around, options);
  FORESIGHT_TRY(const std::vector<DrillState> modes, fit.Search(context));
  if (!(modes.front().log_likelihood > fit.Nothing()))
    return Fail(ErrorCode::kNoConvergence,
                "nothing in the region looks like a drill: draw it around one, or scan slower");
  context.Report(0.8, "trying other shapes");
  FORESIGHT_TRY(DrillDetection detection, fit.Detection(modes, context));
  detection.origin.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  context.Report(1.0, "drill fitted");
  return detection;
}

}  // namespace foresight
