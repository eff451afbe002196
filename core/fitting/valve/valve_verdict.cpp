#include "core/fitting/valve/valve_verdict.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/region_place.h"
#include "core/fitting/valve/valve_evidence.h"
#include "core/fitting/verdict_model.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kMinHits = 40.0;  // independent measurements on the wheel
constexpr double kMaxSeeThrough = 0.15;
constexpr double kAbsurdSeeThrough = 0.25;
constexpr double kMaxBlockedGaps = 0.4;
constexpr double kMinMargin_nats = 10.0;

/// "3 spokes", "a disc", "a lever".
std::string NameOf(const ValveModel& model) {
  if (model.IsLever()) return "a lever";
  return model.spokes == 0 ? "a disc" : fmt::format("{} spokes", model.spokes);
}

/// Why there is no valve to speak of; empty when there may be one.
std::string FailedConfirmationGate(const ValveDetection& detection,
                                   const FitValveOptions& options) {
  const ValveEvidence& evidence = detection.evidence;
  const ValveModel& model = detection.best.model;
  if (evidence.see_through > kAbsurdSeeThrough)
    return fmt::format("{:.0f} % of the beams went through the valve",
                       100.0 * evidence.see_through);
  if (!model.IsLever() && (model.rim_radius_m < 0.9 * options.min_rim_radius_m ||
                           model.rim_radius_m > 1.1 * options.max_rim_radius_m))
    return fmt::format("a rim of {:.0f} mm radius is out of range", 1000.0 * model.rim_radius_m);
  return {};
}

/// What a size or a shape alone says against confirming; empty when nothing does.
std::string FailedShapeGate(const ValveModel& model, const FitValveOptions& options) {
  if (model.IsLever()) return "a bar looks like a lever: check it in the image";
  if (model.spokes == 0) return "no spokes are seen: any round or flat thing looks like this";
  if (model.rim_radius_m < 1.08 * options.min_rim_radius_m ||
      model.rim_radius_m > 1.04 * options.max_rim_radius_m)
    return fmt::format("the rim's radius of {:.0f} mm is at the end of its range",
                       1000.0 * model.rim_radius_m);
  return {};
}

/// Why the valve must not be confirmed.
std::vector<std::string> FailedGates(const RaySet& rays, const RaySet& region,
                                     const ValveDetection& detection,
                                     const FitValveOptions& options) {
  const ValveEvidence& evidence = detection.evidence;
  const ValveCandidate& best = detection.best;
  std::vector<std::string> failed_gates;
  if (const double hits = MeasuredHits(rays, evidence); hits < kMinHits)
    failed_gates.push_back(
        fmt::format("only {:.0f} measurements lie on the valve: scan slower or move closer", hits));
  if (evidence.see_through > kMaxSeeThrough)
    failed_gates.push_back(
        fmt::format("{:.0f} % of the beams went through the valve", 100.0 * evidence.see_through));
  if (evidence.blocked_gaps > kMaxBlockedGaps)
    failed_gates.push_back(
        fmt::format("{:.0f} % of the beams beside the valve's parts did not get through",
                    100.0 * evidence.blocked_gaps));
  if (evidence.margin_nats < kMinMargin_nats && !detection.alternatives.empty())
    failed_gates.push_back(fmt::format("{} and {} fit almost equally well", NameOf(best.model),
                                       NameOf(detection.alternatives.front().model)));
  if (const double off_m = DistanceFromRegionCenter(region, best); off_m > kMaxOffCenter_m)
    failed_gates.push_back(
        fmt::format("the valve lies {:.0f} mm from the region's centre: draw the region around it",
                    1000.0 * off_m));
  if (std::string shape = FailedShapeGate(best.model, options); !shape.empty())
    failed_gates.push_back(std::move(shape));
  return failed_gates;
}

std::string WeakestPoint(const ValveDetection& detection) {
  const ValveEvidence& evidence = detection.evidence;
  if (evidence.arc_coverage < 0.6)
    return fmt::format("only {:.0f} % of the {} is seen", 100.0 * evidence.arc_coverage,
                       detection.best.model.IsLever() ? "lever" : "rim");
  if (evidence.weakest_spoke < 0.4)
    return fmt::format("of the beams on one spoke only {:.0f} % agree",
                       100.0 * evidence.weakest_spoke);
  if (evidence.inlier_ratio < 0.6)
    return fmt::format("only {:.0f} % of the beams on the valve agree with it",
                       100.0 * evidence.inlier_ratio);
  if (evidence.see_through > 0.08)
    return fmt::format("{:.0f} % of the beams went through the valve",
                       100.0 * evidence.see_through);
  if (evidence.blocked_gaps > 0.15)
    return fmt::format("{:.0f} % of the beams beside the valve's parts did not get through",
                       100.0 * evidence.blocked_gaps);
  if (detection.sigma_axis_rad > 0.04)
    return fmt::format("the axis is known to {:.1f} deg only",
                       DegreesFromRadians(detection.sigma_axis_rad));
  return fmt::format("{}, but the next answer is {}", NameOf(detection.best.model),
                     MarginWords(evidence.margin_nats));
}

}  // namespace

Verdict AssessValve(const RaySet& rays, const RaySet& region, const ValveDetection& detection,
                    const FitValveOptions& options) {
  const VerdictModel& model = ShippedVerdictModel("valve", VerdictSourceOf(rays));
  const std::string failed_confirmation = FailedConfirmationGate(detection, options);
  Verdict verdict;
  verdict.failed_gates = FailedGates(rays, region, detection, options);
  model.AddReservation(verdict.failed_gates);
  verdict.features = ValveFeatures(rays, detection);
  verdict.probability = model.Probability(verdict.features);
  if (!failed_confirmation.empty()) {
    verdict.failed_gates.insert(verdict.failed_gates.begin(), failed_confirmation);
    verdict.probability = std::min(verdict.probability, Verdict::kLikely - 0.01);
  }
  verdict.level = LevelFor(verdict.probability, !verdict.failed_gates.empty());
  if (!verdict.failed_gates.empty())
    verdict.reason = verdict.failed_gates.front();
  else if (verdict.level == VerdictLevel::kConfirmed)
    verdict.reason = fmt::format("{} beams on the valve, {:.0f} % of them agree",
                                 detection.evidence.hits, 100.0 * detection.evidence.inlier_ratio);
  else
    verdict.reason = WeakestPoint(detection);
  return verdict;
}

}  // namespace foresight
