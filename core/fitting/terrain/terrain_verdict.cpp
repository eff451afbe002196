#include "core/fitting/terrain/terrain_verdict.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/gate.h"
#include "core/fitting/verdict_model.h"

namespace foresight {
namespace {

// What a confirmed block needs (`packaging/evaluate mixed-choice`; docs/evaluation/terrain.md, "A
// carton is no block"). Edges do not tell a block from a carton of nearly its size: the margins of
// sizes do. Lidar returns, which lie far apart, say too much of what lies beyond an edge.
constexpr int kMinEdges = 2;
constexpr double kMinCover = 0.6;
constexpr double kMaxOutside = 0.1, kMaxOutsideOfReturns = 0.2;
// The odds that a top has a block's size, 4.5 : 1 (docs/evaluation/terrain.md, "Blocks among other
// things"): less is no block to stand on.
constexpr double kMinSize_nats = 1.5;
constexpr double kMaxPlaceSigma_m = 0.010;
constexpr int kUnsureEdges = 1;  // no more than this: UNSURE
// From here on, with the odds above, less than 0.5 % of the toehold area that is offered has no
// block under it, on the scenes at home that the weights were fitted to.
constexpr double kWorthOffering = 0.90;

constexpr double kFarOff = 0.3;  // a margin of sizes beyond this says no more

std::string Edges(int count) {
  static constexpr const char* kWords[] = {"no edge", "one edge", "two edges", "three edges",
                                           "all four edges"};
  return kWords[std::clamp(count, 0, 4)];
}

Gate CoverGate(const BlockEvidence& evidence, double limit) {
  return {.what = "{} of its top is seen",
          .unit = Gate::Unit::kFraction,
          .number = evidence.cover,
          .limit = limit};
}

Gate EdgesGate(const BlockEvidence& evidence, int limit) {
  return {.what = "{} of its four edges are confirmed",
          .number = static_cast<double>(evidence.confirmed_edges),
          .limit = static_cast<double>(limit)};
}

Gate SizeGate(const BlockEvidence& evidence, double limit_nats, VerdictSource source) {
  return {.what = "the odds that it has a block's size are {}",
          .unit = Gate::Unit::kOdds,
          .number = evidence.size_nats,
          .limit = limit_nats,
          .advice = source == VerdictSource::kCloud
                        ? "lidar returns hardly show edges: fit to a dense map, or give the image "
                          "that shows it"
                        : "measure it, or look at it from another side"};
}

double PlaceSigma(const TerrainSurface& block) {
  return std::sqrt(block.covariance(0, 0) + block.covariance(1, 1));
}

Gate PlaceGate(const TerrainSurface& block, double limit_m) {
  return {.what = "its place is known to {}",
          .unit = Gate::Unit::kLength,
          .number = PlaceSigma(block),
          .side = Gate::Side::kAtMost,
          .limit = limit_m,
          .advice = "scan slower or move closer"};
}

/// A map counts as one alone where no image shows the block: terrain looks at no beams behind it.
VerdictSource SourceOf(const RaySet& rays, const RectangleEvidence& evidence) {
  if (rays.dense) return evidence.in_image ? VerdictSource::kDense : VerdictSource::kAlone;
  return evidence.in_image ? VerdictSource::kRaw : VerdictSource::kCloud;
}

/// Why a block must not be confirmed.
std::vector<std::string> FailedGates(const TerrainSurface& block, VerdictSource source) {
  const bool of_map = source == VerdictSource::kDense || source == VerdictSource::kAlone;
  const BlockEvidence& evidence = block.evidence;
  std::vector<std::string> failed;
  AddIfFailed({.what = "part of a larger patch: {} of a block's area lies beyond it",
               .unit = Gate::Unit::kFraction,
               .number = evidence.outside,
               .side = Gate::Side::kAtMost,
               .limit = of_map ? kMaxOutside : kMaxOutsideOfReturns},
              failed);
  AddIfFailed(CoverGate(evidence, kMinCover), failed);
  AddIfFailed(EdgesGate(evidence, kMinEdges), failed);
  AddIfFailed(SizeGate(evidence, kMinSize_nats, source), failed);
  AddIfFailed(PlaceGate(block, kMaxPlaceSigma_m), failed);
  return failed;
}

/// What may be unusual about it.
std::vector<FeatureGate> FeatureGates(const TerrainSurface& block,
                                      const RectangleEvidence& evidence,
                                      const VerdictModel& model) {
  const BlockEvidence& seen = block.evidence;
  const auto mean = [&](const char* feature) { return MeanOf(model, feature); };
  return {{"four_edges", EdgesGate(seen, 4)},
          {"size_error",
           {.what = "its extent differs from a block's by {}",
            .unit = Gate::Unit::kLength,
            .number = evidence.size_error_m,
            .side = Gate::Side::kAtMost,
            .limit = mean("size_error")}},
          {"cover", CoverGate(seen, mean("cover"))},
          {"see_through",
           {.what = "{} of the beams on it went through",
            .unit = Gate::Unit::kFraction,
            .number = seen.see_through,
            .side = Gate::Side::kAtMost,
            .limit = mean("see_through")}},
          {"rms",
           {.what = "its points scatter by {}",
            .unit = Gate::Unit::kLength,
            .number = seen.rms_m,
            .side = Gate::Side::kAtMost,
            .limit = mean("rms")}},
          {"size_nats", SizeGate(seen, mean("size_nats"), model.source)},
          {"log_sigma_place", PlaceGate(block, std::exp(mean("log_sigma_place")))}};
}

std::vector<double> FeaturesOf(const RaySet& rays, const TerrainSurface& block,
                               const RectangleEvidence& evidence) {
  const BlockEvidence& seen = block.evidence;
  const double range_m = (block.base_from_object.translation() - rays.viewpoint).norm();
  double least_inner = 1.0, most_outer = 0.0;
  for (const BlockEdge& edge : evidence.edges) {
    least_inner = std::min(least_inner, edge.inner_support);
    most_outer = std::max(most_outer, edge.outer_support);
  }
  return {seen.cover,
          seen.see_through,
          seen.outside,
          seen.confirmed_edges >= 3 ? 1.0 : 0.0,
          seen.confirmed_edges >= 4 ? 1.0 : 0.0,
          static_cast<double>(evidence.dropping_edges),
          least_inner,
          most_outer,
          std::min(0.1, evidence.size_error_m),
          std::log(std::max(1, seen.points)),
          seen.rms_m,
          block.toehold.slope_rad,
          range_m,
          rays.sigma_m,
          std::log(std::max(1e-4, block.toehold.sigma_tilt_rad / kTiltSigmaFactor)),
          evidence.row == RectangleEvidence::Row::kIn ? 1.0 : 0.0,
          evidence.row == RectangleEvidence::Row::kOut ? 1.0 : 0.0,
          evidence.row_gap_sigmas,
          std::log(PlaceSigma(block)),
          std::clamp(seen.size_margin, -kFarOff, kFarOff),
          seen.size_nats,
          seen.outline_nats};
}

}  // namespace

std::vector<std::string> TerrainFeatureNames() {
  return {"cover",     "see_through", "outside",    "three_edges",     "four_edges",
          "drops",     "least_inner", "most_outer", "size_error",      "log_points",
          "rms",       "tilt",        "range",      "sigma",           "log_sigma_tilt",
          "in_rows",   "out_of_rows", "row_gap",    "log_sigma_place", "size_margin",
          "size_nats", "outline"};
}

Verdict AssessBlock(const RaySet& rays, const TerrainSurface& block,
                    const RectangleEvidence& evidence) {
  const VerdictModel& model = ShippedVerdictModel("terrain", SourceOf(rays, evidence));
  Verdict verdict;
  verdict.features = FeaturesOf(rays, block, evidence);
  verdict.probability = model.Probability(verdict.features);
  verdict.failed_gates = FailedGates(block, model.source);
  model.AddReservation(verdict.failed_gates);
  const bool unsure = verdict.probability < kWorthOffering ||
                      block.evidence.confirmed_edges <= kUnsureEdges ||
                      block.evidence.size_nats < kMinSize_nats;
  verdict.level =
      unsure ? VerdictLevel::kUnsure : LevelFor(verdict.probability, !verdict.failed_gates.empty());
  verdict.reason =
      ReasonOf(verdict, kWorthOffering,
               fmt::format("{} confirmed, {:.0f} % of its top seen",
                           Edges(block.evidence.confirmed_edges), 100.0 * block.evidence.cover),
               WeightiestFirst(model, verdict.features, FeatureGates(block, evidence, model)));
  return verdict;
}

Verdict AssessTerrain(const std::vector<TerrainSurface>& surfaces) {
  Verdict verdict;
  int offered = 0, blocks = 0;
  for (const TerrainSurface& surface : surfaces) {
    if (surface.kind != TerrainSurface::Kind::kBlock) continue;
    ++blocks;
    if (surface.verdict.level == VerdictLevel::kUnsure) continue;
    if (offered++ == 0 || surface.verdict.probability < verdict.probability)
      verdict = surface.verdict;
  }
  verdict.features.clear();
  if (offered == 0)
    verdict.reason = blocks == 0 ? "no block was found"
                                 : fmt::format("none of {} blocks is sure enough", blocks);
  else
    verdict.reason = fmt::format("{} of {} blocks can be stood on; the least sure one: {}", offered,
                                 blocks, verdict.reason);
  return verdict;
}

}  // namespace foresight
