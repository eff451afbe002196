#include "core/fitting/valve/valve_verdict.h"

#include <algorithm>
#include <cmath>

#include "core/fitting/valve/valve_evidence.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kLikely = 0.70;
constexpr double kConfirmed = 0.95;
constexpr double kMinHits = 40.0;  // independent measurements on the wheel
constexpr double kMaxSeeThrough = 0.15;
constexpr double kAbsurdSeeThrough = 0.25;
constexpr double kMaxBlockedGaps = 0.4;
constexpr double kMinMargin_nats = 10.0;
constexpr double kMaxOffCenter_m = 0.15;

double Logistic(double value) {
  return 1.0 / (1.0 + std::exp(-value));
}

/// Weights from 384 synthetic views (a quarter of them walls, boxes and balls; range noise 10 to 30
/// mm, lines 0.25 to 1.5 deg apart, 0.7 to 2.8 m) with five-fold cross-validation: AUC 0.976,
/// calibration error 0.026. Provisional; see the header.
double Probability(const RaySet& rays, const ValveDetection& detection) {
  const ValveEvidence& evidence = detection.evidence;
  // A dense map's rays are not independent: nats count a measurement, not a ray.
  const double measured_hits = std::max(1.0, evidence.hits * std::min(1.0, rays.samples_per_ray));
  const double gain = std::clamp(evidence.gain_nats / measured_hits, 0.0, 5.0);
  return Logistic(-9.26 + 1.58 * std::log1p(std::max(0.0, evidence.margin_nats)) +
                  1.00 * evidence.inlier_share + 1.13 * gain -
                  0.45 * std::log(std::max(1e-4, detection.sigma_axis_rad)) -
                  6.55 * evidence.blocked_gaps);
}

/// Why there is no wheel to speak of; empty when there may be one.
std::string Disbelief(const ValveDetection& detection, const FitValveOptions& options) {
  const ValveEvidence& evidence = detection.evidence;
  const ValveModel& model = detection.best.model;
  // Boxes, balls and badly blurred wheels all fit a disc best.
  if (model.spokes == 0) return "no spokes are seen: any round or flat thing looks like this";
  if (evidence.see_through > kAbsurdSeeThrough)
    return fmt::format("{:.0f} % of the beams went through the wheel",
                       100.0 * evidence.see_through);
  if (model.rim_radius_m < 0.9 * options.min_rim_radius_m ||
      model.rim_radius_m > 1.1 * options.max_rim_radius_m)
    return fmt::format("a rim of {:.0f} mm radius is out of range", 1000.0 * model.rim_radius_m);
  return {};
}

/// Why the wheel must not be confirmed; empty when nothing speaks against it.
std::string Objection(const RaySet& rays, const ValveDetection& detection,
                      const FitValveOptions& options) {
  const ValveEvidence& evidence = detection.evidence;
  const ValveCandidate& best = detection.best;
  // The probability is calibrated on lidar returns only, and a filter that erased a wheel leaves
  // shapes that were never in that population.
  if (rays.dense) return "fitted to the depth map: fit to the lidar points to confirm it";
  const double hits = evidence.hits * std::min(1.0, rays.samples_per_ray);
  if (hits < kMinHits)
    return fmt::format("only {:.0f} measurements lie on the wheel: scan slower or move closer",
                       hits);
  if (evidence.see_through > kMaxSeeThrough)
    return fmt::format("{:.0f} % of the beams went through the wheel",
                       100.0 * evidence.see_through);
  if (evidence.blocked_gaps > kMaxBlockedGaps)
    return fmt::format("{:.0f} % of the beams between the spokes did not get through",
                       100.0 * evidence.blocked_gaps);
  if (evidence.margin_nats < kMinMargin_nats && !detection.rivals.empty())
    return fmt::format("{} and {} spokes fit almost equally well", best.model.spokes,
                       detection.rivals.front().model.spokes);
  if (best.model.rim_radius_m < 1.02 * options.min_rim_radius_m ||
      best.model.rim_radius_m > 0.98 * options.max_rim_radius_m)
    return fmt::format("the rim's radius of {:.0f} mm is at the end of its range",
                       1000.0 * best.model.rim_radius_m);
  const double off_m = DistanceFromRegionCenter(rays, best);
  if (off_m > kMaxOffCenter_m)
    return fmt::format(
        "the wheel lies {:.0f} mm from the region's centre: draw the region around it",
        1000.0 * off_m);
  return {};
}

std::string WeakestPoint(const ValveDetection& detection) {
  const ValveEvidence& evidence = detection.evidence;
  if (evidence.arc_coverage < 0.6)
    return fmt::format("only {:.0f} % of the rim is seen", 100.0 * evidence.arc_coverage);
  if (evidence.inlier_share < 0.6)
    return fmt::format("only {:.0f} % of the beams on the wheel agree with it",
                       100.0 * evidence.inlier_share);
  if (evidence.see_through > 0.08)
    return fmt::format("{:.0f} % of the beams went through the wheel",
                       100.0 * evidence.see_through);
  if (evidence.blocked_gaps > 0.15)
    return fmt::format("{:.0f} % of the beams between the spokes did not get through",
                       100.0 * evidence.blocked_gaps);
  if (detection.sigma_axis_rad > 0.04)
    return fmt::format("the axis is known to {:.1f} deg only",
                       DegreesFromRadians(detection.sigma_axis_rad));
  return fmt::format("the number of spokes leads by {:.0f} nats only", evidence.margin_nats);
}

}  // namespace

Verdict AssessValve(const RaySet& rays, const ValveDetection& detection,
                    const FitValveOptions& options) {
  const std::string disbelief = Disbelief(detection, options);
  const std::string objection = Objection(rays, detection, options);
  Verdict verdict;
  verdict.features = ValveFeatures(rays, detection);
  verdict.probability = Probability(rays, detection);
  if (!objection.empty()) verdict.probability = std::min(verdict.probability, kConfirmed - 0.01);
  if (!disbelief.empty()) verdict.probability = std::min(verdict.probability, kLikely - 0.01);
  verdict.level = verdict.probability >= kConfirmed ? VerdictLevel::kConfirmed
                  : verdict.probability >= kLikely  ? VerdictLevel::kLikely
                                                    : VerdictLevel::kUnsure;
  if (!disbelief.empty())
    verdict.reason = disbelief;
  else if (!objection.empty())
    verdict.reason = objection;
  else if (verdict.level == VerdictLevel::kConfirmed)
    verdict.reason = fmt::format("{} beams on the wheel, {:.0f} % of them agree",
                                 detection.evidence.hits, 100.0 * detection.evidence.inlier_share);
  else
    verdict.reason = WeakestPoint(detection);
  return verdict;
}

}  // namespace foresight
