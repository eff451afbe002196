#include "core/fitting/valve/valve_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numbers>

#include "core/fitting/beam_model.h"
#include "core/fitting/compressed_nats.h"
#include "core/fitting/region_place.h"
#include "core/fitting/valve/valve_coverage.h"
#include "core/fitting/valve/valve_tracer.h"

namespace foresight {
namespace {

constexpr int kBins = 24;
constexpr double kIntersectedFraction = 0.5;
constexpr double kWholeFraction = 0.9;
constexpr double kMaxPhaseSigma_rad = 0.15;

/// Of the rays that intersect one part, those whose range agrees.
struct PartSupport {
  int hits = 0;
  int agreeing = 0;

  double Fraction() const { return hits > 0 ? static_cast<double>(agreeing) / hits : 0.0; }
};

/// Of the rays that cross the plane z = 0 inside the rim (beside a lever: within half its length of
/// its middle) and touch nothing of the valve, the fraction that ends there all the same: a valve
/// is open, a box or a ball is not.
double BlockedGaps(const ValveCandidate& valve, const ValveTracer& tracer,
                   const BeamFootprints& footprints) {
  const RaySet& rays = footprints.Rays();
  const ValveModel& model = valve.model;
  const Eigen::Vector3d axis = valve.base_from_object.Rotate(Eigen::Vector3d::UnitZ());
  const double reach = model.IsLever() ? 0.5 * model.lever_length_m + 4.0 * model.tube_radius_m
                                       : model.rim_radius_m - model.tube_radius_m;
  const Eigen::Vector3d middle =
      valve.base_from_object *
      Eigen::Vector3d(model.IsLever() ? 0.5 * model.lever_length_m : 0.0, 0.0, 0.0);
  int gaps = 0;
  int blocked = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const RangeRay& ray = rays.rays[i];
    const double closing = -axis.dot(ray.direction);
    if (closing < 0.1) continue;
    const double crossing_m = axis.dot(ray.origin - middle) / closing;
    const Eigen::Vector3d crossing = ray.origin + crossing_m * ray.direction;
    if ((crossing - middle).norm() > reach) continue;
    if (tracer.Intersect(ray).Clearance() < footprints.Reach(i)) continue;
    ++gaps;
    if (ray.range_m < crossing_m + rays.sigma_m) ++blocked;
  }
  return gaps > 0 ? static_cast<double>(blocked) / gaps : 0.0;
}

/// Fraction of the middle line's bins that have support: of the rim's circle, or along a lever.
int BinOf(const ValveIntersection& intersection, const ValveModel& model) {
  const double fraction = model.IsLever()
                              ? intersection.along_m / std::max(model.lever_length_m, 1e-6)
                              : intersection.FractionOfRim();
  return std::clamp(static_cast<int>(fraction * kBins), 0, kBins - 1);
}

bool HasPhase(const ValveModel& model) {
  return model.IsLever() || model.spokes > 0;
}

}  // namespace

ValveEvidence GatherEvidence(const BeamFootprints& footprints, const ValveCandidate& valve) {
  const RaySet& rays = footprints.Rays();
  const ValveTracer tracer(valve, ValveParts::kAll);
  const ValvePart outline = valve.model.IsLever() ? ValvePart::kLever : ValvePart::kRim;
  ValveEvidence evidence;
  std::bitset<kBins> covered;
  std::array<PartSupport, 6> spokes;
  int agreeing = 0;
  int behind = 0;
  double square_sum = 0.0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const RangeRay& ray = rays.rays[i];
    ++evidence.rays;
    if (!tracer.Near(ray, 0.0)) continue;
    const ValveIntersection intersection = tracer.Intersect(ray);
    const ExpectedBeam expected =
        footprints.Expect(i, CoverageOf(footprints, i, intersection, valve.brightness));
    if (intersection.Clearance() >= 0.0 || expected.fraction < kIntersectedFraction) continue;
    const double error = ray.range_m - expected.range_m;
    const double agree_m = footprints.Agreement(expected);
    const bool agrees = std::abs(error) <= agree_m;
    if (intersection.part == ValvePart::kSpoke) {
      PartSupport& spoke = spokes[static_cast<std::size_t>(intersection.spoke)];
      ++spoke.hits;
      spoke.agreeing += agrees ? 1 : 0;
    }
    // A footprint that is partly on something unknown may read anything in between.
    if (!agrees && !footprints.ReachesBackground(i) && expected.fraction < kWholeFraction) continue;
    ++evidence.hits;
    if (error > agree_m) ++behind;
    if (!agrees) continue;
    ++agreeing;
    square_sum += error * error;
    if (intersection.part == outline)
      covered.set(static_cast<std::size_t>(BinOf(intersection, valve.model)));
  }
  const double hits = std::max(1, evidence.hits);
  evidence.inlier_ratio = agreeing / hits;
  evidence.see_through = behind / hits;
  evidence.blocked_gaps = BlockedGaps(valve, tracer, footprints);
  evidence.rms_m = std::sqrt(square_sum / std::max(1, agreeing));
  evidence.arc_coverage = static_cast<double>(covered.count()) / kBins;
  evidence.weakest_spoke = 1.0;
  for (int i = 0; i < valve.model.spokes && !valve.model.IsLever(); ++i)
    evidence.weakest_spoke =
        std::min(evidence.weakest_spoke, spokes[static_cast<std::size_t>(i)].Fraction());
  return evidence;
}

void SetCovariance(const PoseCovariance& covariance, ValveDetection& detection) {
  const Eigen::Matrix<double, 6, 1> sigmas = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  detection.sigma_position_m = sigmas.segment<3>(kMoveX);
  detection.sigma_axis_rad = std::max(sigmas[kTiltX], sigmas[kTiltY]);
  detection.sigma_phase_rad = sigmas[kPhase];
  detection.covariance = covariance;
  if (HasPhase(detection.best.model)) return;
  detection.covariance.row(kPhase).setConstant(std::nan(""));
  detection.covariance.col(kPhase).setConstant(std::nan(""));
}

void SetSigmas(const ValveInformation& information, ValveDetection& detection) {
  // The ridge bounds what no ray sees: a phase to a turn, a length to a metre.
  using Known = Eigen::Matrix<double, kRimDepth, kRimDepth>;
  const Known covariance = (information.topLeftCorner<kRimDepth, kRimDepth>() + Known::Identity())
                               .ldlt()
                               .solve(Known::Identity());
  SetCovariance(covariance.topLeftCorner<6, 6>(), detection);
  detection.phase_observable =
      HasPhase(detection.best.model) && detection.sigma_phase_rad < kMaxPhaseSigma_rad;
}

double MeasuredHits(const RaySet& rays, const ValveEvidence& evidence) {
  return evidence.hits * rays.Measured().Worth();
}

Eigen::Vector3d MiddleOf(const ValveCandidate& valve) {
  const double half_m = valve.model.IsLever() ? 0.5 * valve.model.lever_length_m : 0.0;
  return valve.base_from_object * Eigen::Vector3d(half_m, 0.0, 0.0);
}

int Misplacement(const RaySet& rays, const ValveCandidate& valve) {
  const ValveModel& model = valve.model;
  const bool endless = model.IsLever() && model.lever_length_m > 0.99 * kMaxLeverLength_m;
  const Eigen::Vector3d middle = MiddleOf(valve);
  const bool beside = DistanceFromRegionCenter(rays, middle) > kMaxOffCenter_m ||
                      (rays.box && !rays.box->Contains(middle));
  return (beside ? 1 : 0) + (endless ? 2 : 0);
}

double ChanceOfBeingOff(const ValveDetection& detection) {
  const auto beyond = [](double limit, double sigma) {
    return std::erfc(limit / (std::numbers::sqrt2 * std::max(sigma, 1e-6)));
  };
  return 1.0 - (1.0 - beyond(kRightPlace_m, detection.sigma_position_m.norm())) *
                   (1.0 - beyond(kRightAxis_rad, detection.sigma_axis_rad));
}

std::vector<std::string> ValveFeatureNames() {
  return {"log_margin",
          "margin_line_sigmas",
          "gain_per_hit",
          "log_hits",
          "inlier_ratio",
          "see_through",
          "blocked_gaps",
          "arc_coverage",
          "weakest_spoke_gain",
          "log_sigma_along",
          "log_sigma_tilt",
          "log_chance_off",
          "log_size",
          "log_width",
          "disc",
          "lever",
          "outline",
          "weakest_outline",
          "further_outline"};
}

std::vector<double> ValveFeatures(const RaySet& rays, const ValveDetection& detection) {
  const ValveEvidence& evidence = detection.evidence;
  const ValveModel& model = detection.best.model;
  const double hits = std::max(1.0, MeasuredHits(rays, evidence));
  const double size_m = model.IsLever() ? model.lever_length_m : model.rim_radius_m;
  const bool disc = !model.IsLever() && model.spokes == 0;
  return {std::log1p(std::max(0.0, evidence.margin_nats)),
          std::clamp(evidence.margin_line_sigmas, -2.0, 10.0),
          std::clamp(evidence.gain_nats / hits, 0.0, 5.0),
          std::log(hits),
          evidence.inlier_ratio,
          evidence.see_through,
          evidence.blocked_gaps,
          evidence.arc_coverage,
          Compressed(evidence.weakest_spoke_nats),
          std::log(std::max(1e-4, detection.sigma_position_m.z())),
          std::log(std::max(1e-4, detection.sigma_axis_rad)),
          std::log(1e-4 + ChanceOfBeingOff(detection)),
          std::log(size_m),
          std::log(std::max(1e-3, model.tube_radius_m)),
          disc ? 1.0 : 0.0,
          model.IsLever() ? 1.0 : 0.0,
          evidence.outline_nats_per_px,
          evidence.weakest_outline_nats_per_px,
          evidence.further_outline_nats_per_px};
}

}  // namespace foresight
