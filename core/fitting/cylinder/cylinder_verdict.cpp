#include "core/fitting/cylinder/cylinder_verdict.h"

#include <cmath>

#include "core/fitting/common_gates.h"
#include "core/fitting/gate.h"

namespace foresight {
namespace {

constexpr double kLikelyHits = 30.0;  // independent measurements
constexpr double kLikelyInliers = 0.6;
constexpr double kLikelySeeThrough = 0.10;
constexpr double kLikelyArc_rad = 1.2;
constexpr double kLikelyMargin_nats = 5.0;
constexpr double kLikelyRadiusSigma = 0.15;  // of the radius

/// Why it is not LIKELY: what it misses.
std::vector<std::string> FailedGates(const RaySet& rays, const CylinderBounds& bounds,
                                     const CylinderDetection& found) {
  const CylinderEvidence& evidence = found.evidence;
  std::vector<std::string> failed;
  AddIfFailed(MeasurementsGate("it", evidence.hits * rays.Worth(), kLikelyHits), failed);
  AddIfFailed(SeeThroughGate("it", evidence.see_through, kLikelySeeThrough), failed);
  AddIfFailed(AgreementGate("it", evidence.inlier_ratio, kLikelyInliers), failed);
  if (evidence.in_drawn_box)
    AddIfFailed({.what = "{} of the beams on it end in the box that was drawn",
                 .unit = Gate::Unit::kFraction,
                 .number = *evidence.in_drawn_box,
                 .limit = kLeastInDrawnBox,
                 .advice = "it may be something in front of the box or behind it"},
                failed);
  Gate box = AlternativeGate("box", evidence.box_margin_nats, kLikelyMargin_nats);
  box.advice = "it may be square, or a wall's edge";
  AddIfFailed(box, failed);
  AddIfFailed({.what = "{} of its girth are seen",
               .unit = Gate::Unit::kAngle,
               .number = evidence.seen_arc_rad,
               .limit = kLikelyArc_rad},
              failed);
  AddIfFailed({.what = "its radius is known to {}",
               .unit = Gate::Unit::kLength,
               .number = found.sigma_radius_m,
               .side = Gate::Side::kAtMost,
               .limit = kLikelyRadiusSigma * found.model.radius_m},
              failed);
  AddIfFailed({.what = "{} of its length are seen",
               .unit = Gate::Unit::kLength,
               .number = found.model.length_m,
               .limit = found.model.radius_m,
               .limit_note = "of this radius"},
              failed);
  AddIfOutside({.what = "its radius is {}",
                .unit = Gate::Unit::kLength,
                .number = found.model.radius_m,
                .advice = "it is at the end of the range of radii"},
               1.02 * bounds.min_radius_m, 0.98 * bounds.max_radius_m, failed);
  return failed;
}

}  // namespace

void Assess(const RaySet& rays, const CylinderBounds& bounds, CylinderDetection& detection) {
  constexpr const char* kNotCalibrated =
      "never confirmed, as no probability was calibrated for cylinders";
  Verdict& verdict = detection.verdict;
  verdict.probability = std::nan("");
  verdict.failed_gates = FailedGates(rays, bounds, detection);
  const bool likely = verdict.failed_gates.empty();
  verdict.level = likely ? VerdictLevel::kLikely : VerdictLevel::kUnsure;
  verdict.reason =
      likely ? fmt::format("{} beams on it, {:.0f} % of them agree; {}", detection.evidence.hits,
                           100.0 * detection.evidence.inlier_ratio, kNotCalibrated)
             : verdict.failed_gates.front();
  verdict.failed_gates.push_back(kNotCalibrated);
}

}  // namespace foresight
