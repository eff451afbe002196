#include "core/fitting/valve/fit_valve.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

#include "core/base/parallel.h"
#include "core/fitting/ray_selection.h"
#include "core/fitting/valve/lever_search.h"
#include "core/fitting/valve/local_search.h"
#include "core/fitting/valve/outline_evidence.h"
#include "core/fitting/valve/part_evidence.h"
#include "core/fitting/valve/refine.h"
#include "core/fitting/valve/rim_search.h"
#include "core/fitting/valve/ring_before_pipe.h"
#include "core/fitting/valve/spoke_search.h"
#include "core/fitting/valve/thin_rims.h"
#include "core/fitting/valve/valve_covariance.h"
#include "core/fitting/valve/valve_coverage.h"
#include "core/fitting/valve/valve_evidence.h"
#include "core/fitting/valve/valve_state.h"
#include "core/fitting/valve/valve_verdict.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr int kMinRays = 60;
constexpr int kMinForeground = 25;
constexpr int kRimPoints = 500;  // of the foreground, for the circle search
constexpr int kGridRays = 900;   // for the grid of dish and phase
constexpr std::size_t kKeptRims = 2;
constexpr std::size_t kLocallySearched = 2;  // numbers of spokes
constexpr int kAlternatives = 3;
// Radii of the valve that a closer look takes in, and the largest part of a region that it is worth
// while for. A map's rays know each other: what suits it was not tried again.
constexpr double kAround = 1.3, kAroundInMap = 1.7;
constexpr double kWorthwhile = 0.9, kWorthwhileInMap = 0.5;
constexpr std::size_t kLocallySearchedLevers = 3;
// Fits to wheels lie behind them, in the median of training scenes at home and under varied
// conditions: by 0.2 and 2.5 mm from lidar returns and clouds, by 2.2 to 3.6 and 4.7 mm from maps
// (docs/evaluation/valve.md, "Fits lie behind their wheels").
constexpr double kBeamsLack_m = 0.0013, kMapsLack_m = 0.0035;
constexpr double kHopeless_nats = 200.0;  // more than local search brings
constexpr double kTubeRadius_m = 0.012;   // where the search starts
// What an image's nat counts beside a ray's, as of levers' ways (docs/evaluation/valve.md, "Spokes
// in the image").
constexpr double kImageNat = 0.3;

/// Streams of the seed: each stage draws its own numbers.
enum Stream : std::uint64_t { kThinning, kWall, kRims, kLevers };

void SortByLikelihood(std::vector<ValveCandidate>& valves) {
  std::stable_sort(valves.begin(), valves.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
}

tl::unexpected<Error> Cancelled() {
  return Fail(ErrorCode::kCancelled, "fitting the valve was cancelled");
}

/// Changes each of them, on as many threads as there are.
Status ForEach(std::span<ValveCandidate> valves, const RunContext& context,
               const std::function<void(ValveCandidate&)>& change) {
  if (ParallelFor(static_cast<int>(std::ssize(valves)), context,
                  [&](int i) { change(valves[static_cast<std::size_t>(i)]); }))
    return {};
  return Cancelled();
}

std::vector<int> SpokeCounts(const FitValveOptions& options) {
  std::vector<int> counts = {0};
  for (int n = options.min_spokes; n <= options.max_spokes; ++n) counts.push_back(n);
  return counts;
}

Status CheckForeground(const RaySet& rays, const WallSplit& split) {
  if (std::ssize(split.foreground) >= kMinForeground) return {};
  return Fail(ErrorCode::kNoConvergence,
              "only {} of {} measurements stand in front of the wall: draw the region around the "
              "valve",
              split.foreground.size(), rays.rays.size());
}

/// From what stands before the wall to the viewer.
Eigen::Vector3d Sight(const RaySet& rays, const WallSplit& split) {
  const Eigen::Vector3d middle = std::accumulate(split.foreground.begin(), split.foreground.end(),
                                                 Eigen::Vector3d(Eigen::Vector3d::Zero())) /
                                 static_cast<double>(split.foreground.size());
  return (rays.viewpoint - middle).normalized();
}

/// Where a valve's axis points, roughly: off its wall. What is seen as the largest plane need not
/// be its wall. Through a wheel that stands free it is the floor; then the axis may point to the
/// viewer as well.
std::vector<Eigen::Vector3d> Facings(const RaySet& rays, const WallSplit& split) {
  const Eigen::Vector3d sight = Sight(rays, split);
  if (!split.wall) return {sight};
  std::vector<Eigen::Vector3d> facings = {split.wall->normal};
  if (sight.dot(split.wall->normal) < std::cos(RimSearchOptions().max_tilt_rad))
    facings.push_back(sight);
  return facings;
}

/// Where rims may be.
std::vector<ValveCandidate> SearchRims(const RaySet& rays, const WallSplit& split,
                                       const BeamLikelihood& coarse,
                                       const FitValveOptions& options) {
  Random random(options.seed, kRims);
  const std::vector<Eigen::Vector3d> points = RandomSubset(split.foreground, kRimPoints, random);
  RimSearchOptions search;
  search.min_radius_m = options.min_rim_radius_m;
  search.max_radius_m = options.max_rim_radius_m;
  search.tolerance_m = 2.0 * rays.sigma_m + 0.008;
  search.trials = options.circle_trials;
  std::vector<ValveCandidate> rims;
  for (const Eigen::Vector3d& facing : Facings(rays, split)) {
    search.facing = facing;
    for (const RimHypothesis& rim : FindRims(points, search, random))
      rims.push_back(RimFrom(rim, kTubeRadius_m));
    const std::vector<ValveCandidate> thin =
        SearchThinRims(points, rays.viewpoint, coarse, search, random);
    rims.insert(rims.end(), thin.begin(), thin.end());
  }
  return rims;
}

/// Rims as valves without spokes, fitted to the rays, the best few first.
Result<std::vector<ValveCandidate>> FitRims(const BeamLikelihood& likelihood,
                                            std::vector<ValveCandidate> rims,
                                            const RunContext& context) {
  RefineOptions options;
  options.parts = ValveParts::kRim;
  FORESIGHT_CHECK(ForEach(rims, context, [&](ValveCandidate& rim) {
    rim.log_likelihood = ScoreOf(rim, likelihood, ValveParts::kRim);
    ValveCandidate refined = Refine(likelihood.Footprints(), rim, options);
    refined.log_likelihood = ScoreOf(refined, likelihood, ValveParts::kRim);
    if (refined.log_likelihood > rim.log_likelihood) rim = refined;
  }));
  KeepDistinctRims(kKeptRims, rims);
  return rims;
}

/// The best lever, if there is a bar at all; only roughly placed when it is far behind
/// `alternative`.
Result<std::optional<ValveCandidate>> FitLever(const RaySet& rays, const WallSplit& split,
                                               const BeamLikelihood& likelihood,
                                               const std::optional<ValveCandidate>& alternative,
                                               const FitValveOptions& options,
                                               const RunContext& context) {
  Random random(options.seed, kLevers);
  const std::vector<Eigen::Vector3d> points = RandomSubset(split.foreground, kRimPoints, random);
  LeverSearchOptions search;
  search.facing = Facings(rays, split).back();
  search.tolerance_m = 1.5 * rays.sigma_m + 0.012;
  const std::vector<ValveCandidate> found = FindLevers(points, search, random);
  // Each as it was found and refined.
  std::vector<ValveCandidate> levers(2 * found.size());
  const auto fit = [&](int i) {
    const ValveCandidate& start = found[static_cast<std::size_t>(i / 2)];
    ValveCandidate& lever = levers[static_cast<std::size_t>(i)];
    lever = i % 2 == 0 ? start : Refine(likelihood.Footprints(), start, {});
    lever.log_likelihood = ScoreOf(lever, likelihood);
  };
  if (!ParallelFor(static_cast<int>(levers.size()), context, fit)) return Cancelled();
  SortByLikelihood(levers);
  if (levers.empty()) return std::nullopt;
  if (alternative && levers.front().log_likelihood < alternative->log_likelihood - kHopeless_nats)
    return levers.front();
  // The likelihood has many small peaks along a bar: some of them are climbed.
  if (levers.size() > kLocallySearchedLevers) levers.resize(kLocallySearchedLevers);
  FORESIGHT_CHECK(ForEach(levers, context,
                          [&](ValveCandidate& lever) { lever = LocalSearch(likelihood, lever); }));
  SortByLikelihood(levers);
  return levers.front();
}

/// The best first, behind it what the region can hardly have been drawn round.
void SortByPlaceAndLikelihood(const RaySet& region, std::vector<ValveCandidate>& valves) {
  std::vector<std::pair<int, ValveCandidate>>
      placed;  // a place is judged by all of a region's rays
  for (const ValveCandidate& valve : valves)
    placed.emplace_back(Misplacement(region, valve), valve);
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, -a.second.log_likelihood) <
           std::pair(b.first, -b.second.log_likelihood);
  });
  for (std::size_t i = 0; i < valves.size(); ++i) valves[i] = placed[i].second;
}

/// Runs local search on the leading candidates and puts them back in order.
Status LocalSearchOfLeaders(const RaySet& region, const BeamLikelihood& likelihood,
                            std::vector<ValveCandidate>& valves, const RunContext& context) {
  const std::span leaders(valves.begin(), std::min(kLocallySearched, valves.size()));
  FORESIGHT_CHECK(ForEach(leaders, context,
                          [&](ValveCandidate& valve) { valve = LocalSearch(likelihood, valve); }));
  SortByPlaceAndLikelihood(region, valves);
  return {};
}

/// Asks an image which of the candidates that rays do not leave far behind has its parts: rays have
/// each in its place to a pixel or two, and the sides of a spoke lie further apart.
void RankByImage(const RaySet& region, const BeamLikelihood& likelihood,
                 std::vector<ValveCandidate>& valves) {
  if (region.image == nullptr) return;
  const double least = valves.front().log_likelihood - kHopeless_nats;
  std::size_t first = 0;
  for (std::size_t i = 0; i < valves.size(); ++i) {
    ValveCandidate& valve = valves[i];
    if (valve.log_likelihood < least) continue;
    valve.image_nats = kImageNat * NatsOfOutline(*region.image, valve);
    valve.log_likelihood += valve.image_nats;
    if (valve.log_likelihood > valves[first].log_likelihood) first = i;
  }
  // It was placed roughly only.
  if (first >= kLocallySearched) {
    const double image_nats = valves[first].image_nats;
    valves[first] = LocalSearch(likelihood, valves[first]);
    valves[first].image_nats = image_nats;
    valves[first].log_likelihood += image_nats;
  }
  SortByPlaceAndLikelihood(region, valves);
}

/// From rays of the region to the best valve among them; places are judged against the region.
/// Without `has_wall` nothing flat is taken for one.
Result<ValveDetection> Search(const RaySet& region, const RaySet& all_rays, bool has_wall,
                              const FitValveOptions& options, const RunContext& context) {
  context.Report(0.0, "looking for the wall");
  Random thinning(options.seed, kThinning);
  Random wall_random(options.seed, kWall);
  RaySet rays = Thinned(all_rays, options.max_rays, thinning);
  RaySet few_rays = Thinned(rays, kGridRays, thinning);
  few_rays.beams = nullptr;
  rays.beams = ThinnedBeams(all_rays, options.max_rays, kMinRays, thinning);
  const WallSplit split = has_wall ? SplitWall(rays, wall_random) : NoWall(rays);
  if (context.Cancelled()) return Cancelled();

  context.Report(0.1, "looking for the rim");
  FORESIGHT_CHECK(CheckForeground(rays, split));
  const BeamLikelihood likelihood = ValveLikelihood(rays, split.wall);
  const BeamLikelihood coarse = ValveLikelihood(few_rays, split.wall);
  FORESIGHT_TRY(const std::vector<ValveCandidate> rims,
                FitRims(likelihood, SearchRims(rays, split, coarse, options), context));

  context.Report(0.3, "counting the spokes");
  FORESIGHT_TRY(std::vector<ValveCandidate> valves,
                FindSpokes(coarse, likelihood, rims, SpokeCounts(options), context));
  std::optional<ValveCandidate> wheel;
  if (!valves.empty()) wheel = valves.front();
  FORESIGHT_TRY(const std::optional<ValveCandidate> lever,
                FitLever(rays, split, likelihood, wheel, options, context));
  if (lever) valves.push_back(*lever);
  if (valves.empty())
    return Fail(ErrorCode::kNoConvergence,
                "nothing round of {:.0f} to {:.0f} mm radius and no lever stands in the region: "
                "draw it around the valve",
                1000.0 * options.min_rim_radius_m, 1000.0 * options.max_rim_radius_m);
  SortByPlaceAndLikelihood(region, valves);
  context.Report(0.7, "improving the pose");
  FORESIGHT_CHECK(LocalSearchOfLeaders(region, likelihood, valves, context));
  RankByImage(region, likelihood, valves);

  ValveDetection detection;
  detection.best = WithUpwardSpoke(valves.front());
  const double gain_nats =
      detection.best.log_likelihood - detection.best.image_nats - likelihood.Nothing();
  if (!(gain_nats > 0.0))
    return Fail(ErrorCode::kNoConvergence,
                "nothing in the region looks like a wheel: draw it around one, or scan slower");
  for (std::size_t i = 1; i < valves.size() && i <= kAlternatives; ++i)
    detection.alternatives.push_back(WithUpwardSpoke(valves[i]));
  SetSigmas(InformationAt(likelihood.Footprints(), detection.best, {}), detection);
  detection.evidence = GatherEvidence(likelihood.Measured().Footprints(), detection.best);
  detection.evidence.margin_nats =
      valves.size() > 1 ? valves[0].log_likelihood - valves[1].log_likelihood : 0.0;
  detection.evidence.gain_nats = gain_nats;
  if (valves.size() > 1)
    detection.evidence.margin_line_sigmas =
        likelihood.DeviationsAhead(CoverBy(valves[0]), CoverBy(valves[1]));
  AddEvidenceOfParts(likelihood, detection.best, detection.evidence);
  detection.evidence.pipe_margin_nats = MarginOverPipe(likelihood.Measured(), detection.best);
  if (region.image) AddEvidenceOfOutline(*region.image, detection.best, detection.evidence);
  WidenSigmas(likelihood.Footprints(), detection);
  detection.verdict = AssessValve(rays, region, detection, options);
  return detection;
}

/// A region drawn far too large leaves few of the thinned rays on the valve: those of all its rays
/// that pass near what was found. nullopt where they would bring nothing new.
std::optional<RaySet> RaysForCloserLook(const RaySet& region, const ValveCandidate& valve,
                                        const FitValveOptions& options) {
  if (std::ssize(region.rays) <= options.max_rays) return std::nullopt;
  const ValveModel& model = valve.model;
  const double size_m = model.IsLever() ? 0.5 * model.lever_length_m : model.rim_radius_m;
  const double reach_m = (region.dense ? kAroundInMap : kAround) * size_m + 0.03;
  RaySet around = region;
  const auto far_off = [&, middle = MiddleOf(valve)](const RangeRay& ray) {
    return (middle - ray.origin).cross(ray.direction).norm() > reach_m;
  };
  std::erase_if(around.rays, far_off);
  if (region.beams) {
    RaySet beams = *region.beams;
    std::erase_if(beams.rays, far_off);
    around.beams = std::make_shared<const RaySet>(std::move(beams));
  }
  if (std::ssize(around.rays) < kMinRays ||
      static_cast<double>(around.rays.size()) >=
          (region.dense ? kWorthwhileInMap : kWorthwhile) * static_cast<double>(region.rays.size()))
    return std::nullopt;
  return around;
}

/// A footprint that a rim does not fill is drawn to the wall, and a map draws the rim there too:
/// the valve stands that much nearer to the viewer, along its axis.
void BringNearer(bool map, ValveDetection& detection) {
  const Rigid<frame::Object, frame::Object> nearer(Eigen::Quaterniond::Identity(),
                                                   {0.0, 0.0, map ? kMapsLack_m : kBeamsLack_m});
  const auto bring = [&nearer](ValveCandidate& valve) {
    valve.base_from_object = valve.base_from_object * nearer;
  };
  bring(detection.best);
  std::for_each(detection.alternatives.begin(), detection.alternatives.end(), bring);
}

}  // namespace

Status FitValveOptions::Check() const {
  if (!(min_rim_radius_m > 0.0) || !(max_rim_radius_m > min_rim_radius_m))
    return Fail(
        ErrorCode::kInvalidOptions,
        "valve fit: rims of {:.0f} to {:.0f} mm radius are no range: the smallest must be above "
        "0 and below the largest",
        1000.0 * min_rim_radius_m, 1000.0 * max_rim_radius_m);
  if (min_spokes < 2 || max_spokes > 6 || min_spokes > max_spokes)
    return Fail(ErrorCode::kInvalidOptions, "valve fit: {} to {} spokes are no range within 2 to 6",
                min_spokes, max_spokes);
  if (circle_trials < 1)
    return Fail(ErrorCode::kInvalidOptions, "valve fit: circle_trials {} is below 1",
                circle_trials);
  if (max_rays < kMinRays)
    return Fail(ErrorCode::kInvalidOptions, "valve fit: max_rays {} is below {}", max_rays,
                kMinRays);
  return {};
}

Result<ValveDetection> FitValve(const RaySet& all_rays, const FitValveOptions& options,
                                const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(const RaySet region, UsableRays(all_rays, kMinRays, "a wheel"));
  bool has_wall = true;
  Result<ValveDetection> found = Search(region, region, has_wall, options, context.Part(0.0, 0.4));
  if (!found && found.error().code == ErrorCode::kNoConvergence) {
    // The flat thing that all lies on may be the wheel itself, with nothing behind it.
    Result<ValveDetection> free = Search(region, region, false, options, context.Part(0.4, 0.5));
    if (!free && free.error().code == ErrorCode::kCancelled) return free;
    has_wall = !free || free->verdict.level == VerdictLevel::kUnsure;
    if (!has_wall) found = std::move(free);
  }
  if (!found) return found;
  ValveDetection detection = std::move(*found);
  if (const auto around = RaysForCloserLook(region, detection.best, options)) {
    Result<ValveDetection> closer =
        Search(region, *around, has_wall, options, context.Part(0.5, 1.0));
    if (closer)
      detection = std::move(*closer);
    else if (closer.error().code == ErrorCode::kCancelled)
      return closer;
  }
  BringNearer(region.dense, detection);
  detection.origin.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  context.Report(1.0, "valve fitted");
  return detection;
}

}  // namespace foresight
