#include "core/fitting/drill/drill_verdict.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fitting/drill/solid_tracer.h"
#include "core/fitting/drill/support_and_background.h"
#include "core/fitting/gate.h"
#include "core/fitting/region_place.h"
#include "core/fitting/verdict_model.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kAgreeSigmas = 3.0;
constexpr double kTemplateError_m = 0.005;
constexpr double kEdgeError_m = 0.003;

constexpr double kMaxOutside_m = 0.025;  // of a part's middle; lines may be 44 mm apart
constexpr double kMinHits = 40.0;        // independent measurements on the drill
constexpr double kMaxSeeThrough = 0.15;
constexpr double kMinYawMargin_nats = 10.0;
// Errors of a dense map's pixels come together: of 144 drawn drills 4 pointed the wrong way by more
// than 10 nats, 1 of them by more than 30.
constexpr double kMinYawMarginDense_nats = 30.0;
constexpr double kMinHead_nats = 10.0;
constexpr double kBound = 0.01;  // of the range of a scale

double Compressed(double nats) {
  return std::copysign(std::log1p(std::abs(nats)), nats);
}

double Hits(const RaySet& rays, const DrillEvidence& evidence) {
  return evidence.hits * std::min(1.0, rays.samples_per_ray);
}

std::vector<double> FeaturesOf(const RaySet& rays, const DrillDetection& detection) {
  const DrillEvidence& evidence = detection.evidence;
  const double hits = std::max(1.0, Hits(rays, evidence));
  return {Compressed(evidence.yaw_margin_nats),
          Compressed(evidence.head_nats),
          Compressed(evidence.alternative_margin_nats),
          evidence.alternative_margin_nats / hits,
          evidence.gain_nats / hits,
          evidence.inlier_ratio,
          evidence.see_through,
          std::log(hits),
          std::log(std::max(1e-3, detection.sigma_yaw_rad)),
          std::abs(std::log(detection.best.model.scale)),
          detection.best.model.body_tilt_rad.norm()};
}

Gate SeeThroughGate(const DrillEvidence& evidence, double limit) {
  return {.what = "{} of the beams went through the drill",
          .unit = Gate::Unit::kFraction,
          .number = evidence.see_through,
          .side = Gate::Side::kAtMost,
          .limit = limit};
}

Gate AlternativeGate(const DrillEvidence& evidence, double limit_nats) {
  return {
      .what = fmt::format("the odds against a {} in its place are {{}}", evidence.best_alternative),
      .unit = Gate::Unit::kOdds,
      .number = evidence.alternative_margin_nats,
      .limit = limit_nats};
}

/// What its direction has against it: the first of these that it misses.
std::vector<Gate> DirectionGates(const DrillEvidence& evidence, bool dense) {
  const double least_margin = dense ? kMinYawMarginDense_nats : kMinYawMargin_nats;
  return {{.what = "the odds that a head is seen are {}",
           .unit = Gate::Unit::kOdds,
           .number = evidence.head_nats,
           .limit = kMinHead_nats,
           .advice = "it may point either way"},
          {.what = "the odds against the same drill turned by 180 deg are {}",
           .unit = Gate::Unit::kOdds,
           .number = evidence.flip_margin_nats,
           .limit = least_margin,
           .advice = "it may point either way"},
          {.what = "the odds against another direction are {}",
           .unit = Gate::Unit::kOdds,
           .number = evidence.yaw_margin_nats,
           .limit = least_margin}};
}

/// A part of the drill that the region does not show, so that nobody saw whether it is there. A bit
/// may stick out.
void AddPartOutside(const RaySet& region, const DrillCandidate& drill,
                    std::vector<std::string>& failed) {
  for (const SolidPart& part : drill.model.parts) {
    if (part.name == "bit") continue;
    const Gate gate{.what = fmt::format("its {} lies {{}} outside of the region", part.name),
                    .unit = Gate::Unit::kLength,
                    .number = DistanceFromRays(
                        region, drill.base_from_object * part.object_from_part.translation()),
                    .side = Gate::Side::kAtMost,
                    .limit = kMaxOutside_m,
                    .advice = "draw the region around all of it"};
    AddIfFailed(gate, failed);
    if (gate.Failed()) return;
  }
}

/// What a size or a lean at its bound says.
void AddFailedBoundGates(const DrillModel& model, const DrillState& drill, const DrillPrior& prior,
                         std::vector<std::string>& failed) {
  const double range = drill.kind->max_scale - drill.kind->min_scale;
  Gate size{.what = "its size is {} of the template's",
            .unit = Gate::Unit::kRatio,
            .number = model.scale,
            .limit = drill.kind->min_scale + kBound * range,
            .advice = "at the end of the range of sizes nothing is confirmed"};
  AddIfFailed(size, failed);
  size.side = Gate::Side::kAtMost;
  size.limit = drill.kind->max_scale - kBound * range;
  AddIfFailed(size, failed);
  AddIfFailed({.what = "it leans by {}",
               .unit = Gate::Unit::kAngle,
               .number = model.body_tilt_rad.norm(),
               .side = Gate::Side::kAtMost,
               .limit = 0.95 * prior.max_tilt_rad},
              failed);
}

/// Why the drill must not be confirmed.
std::vector<std::string> FailedGates(const RaySet& rays, const RaySet& region,
                                     const DrillDetection& detection, const DrillState& drill,
                                     const DrillPrior& prior) {
  const DrillEvidence& evidence = detection.evidence;
  const DrillModel& model = detection.best.model;
  std::vector<std::string> failed;
  if (!detection.table)
    failed.push_back("no table is seen under it: draw the region a little lower");
  AddIfFailed({.what = "{} measurements lie on the drill",
               .number = Hits(rays, evidence),
               .limit = kMinHits,
               .advice = "scan slower or move closer"},
              failed);
  AddIfFailed(SeeThroughGate(evidence, kMaxSeeThrough), failed);
  // As likely as the drill, or not looked at, is not behind: the limit is just above 0.
  AddIfFailed(AlternativeGate(evidence, std::numeric_limits<double>::min()), failed);
  AddPartOutside(region, detection.best, failed);
  for (const Gate& gate : DirectionGates(evidence, rays.dense)) {
    AddIfFailed(gate, failed);
    if (gate.Failed()) break;
  }
  AddFailedBoundGates(model, drill, prior, failed);
  AddIfFailed({.what = "the drill lies {} from the region's centre",
               .unit = Gate::Unit::kLength,
               .number = DistanceFromRegionCenter(
                   region, detection.best.base_from_object * model.object_from_grasp.translation()),
               .side = Gate::Side::kAtMost,
               .limit = kMaxOffCenter_m,
               .advice = "draw the region around it"},
              failed);
  return failed;
}

/// The nats that Compressed made a value of.
double Expanded(double value) {
  return std::copysign(std::expm1(std::abs(value)), value);
}

/// What may be unusual about it.
std::vector<FeatureGate> FeatureGates(const DrillDetection& detection, const VerdictModel& model) {
  const DrillEvidence& evidence = detection.evidence;
  const auto mean = [&](const char* feature) { return MeanOf(model, feature); };
  const auto usual_nats = [&](const char* feature) {
    return std::min(kFarBehind_nats, Expanded(mean(feature)));
  };
  return {
      {"inlier_ratio",
       {.what = "{} of the beams on the drill agree with it",
        .unit = Gate::Unit::kFraction,
        .number = evidence.inlier_ratio,
        .limit = mean("inlier_ratio")}},
      {"see_through", SeeThroughGate(evidence, mean("see_through"))},
      {"log_sigma_yaw",
       {.what = "its direction is known to {}",
        .unit = Gate::Unit::kAngle,
        .number = detection.sigma_yaw_rad,
        .side = Gate::Side::kAtMost,
        .limit = std::exp(mean("log_sigma_yaw"))}},
      {"log_yaw_margin",
       {.what = "the odds against another direction are {}",
        .unit = Gate::Unit::kOdds,
        .number = evidence.yaw_margin_nats,
        .limit = usual_nats("log_yaw_margin")}},
      {"log_head",
       {.what = "the odds that a head is seen are {}",
        .unit = Gate::Unit::kOdds,
        .number = evidence.head_nats,
        .limit = usual_nats("log_head")}},
      {"log_alternative_margin", AlternativeGate(evidence, usual_nats("log_alternative_margin"))}};
}

double Squared(double value) {
  return value * value;
}

}  // namespace

DrillEvidence GatherEvidence(const RaySet& rays, const DrillCandidate& drill) {
  const SolidTracer tracer(drill.model.parts, drill.base_from_object);
  const double agree_m = kAgreeSigmas * std::hypot(rays.sigma_m, kTemplateError_m);
  DrillEvidence evidence;
  int agreeing = 0;
  int behind = 0;
  double square_sum = 0.0;
  for (const RangeRay& ray : rays.rays) {
    ++evidence.rays;
    const SolidIntersection intersection = tracer.Intersect(ray, 0.0);
    if (!intersection.Hits()) continue;
    ++evidence.hits;
    const double error = ray.range_m - intersection.range_m;
    if (error > agree_m) ++behind;
    if (std::abs(error) > agree_m) continue;
    ++agreeing;
    square_sum += error * error;
  }
  const double hits = std::max(1, evidence.hits);
  evidence.inlier_ratio = agreeing / hits;
  evidence.see_through = behind / hits;
  evidence.rms_m = std::sqrt(square_sum / std::max(1, agreeing));
  return evidence;
}

DrillInformation InformationOf(const RaySet& rays, const DrillState& drill,
                               const TableFrame& base_from_table, const DrillPrior& prior) {
  constexpr double kStep = 1e-3;  // metres and radians
  constexpr double kReach_m = 0.02;
  const double sigma = std::hypot(rays.sigma_m, kTemplateError_m);
  const auto tracer_at = [&](const DrillState& state) {
    return SolidTracer(state.Model().parts, state.Pose(base_from_table));
  };
  const SolidTracer here = tracer_at(drill);
  std::vector<SolidTracer> moved;
  std::array<double, kDrillParameters> steps;
  for (int p = 0; p < kDrillParameters; ++p) {
    DrillState state = drill;
    // A bit cannot be shorter than none.
    steps[static_cast<std::size_t>(p)] = kStep;
    state.values[p] += kStep;
    moved.push_back(tracer_at(state));
  }
  DrillInformation information = DrillInformation::Zero();
  for (const RangeRay& ray : rays.rays) {
    const SolidIntersection intersection = here.IntersectWithDepth(ray, kReach_m);
    if (intersection.part < 0) continue;
    const double width = 0.5 * rays.footprint_rad * ray.range_m + kEdgeError_m;
    const bool inside = intersection.Hits();
    if (inside && std::abs(ray.range_m - intersection.range_m) > kAgreeSigmas * sigma) continue;
    // A ray that grazes the outline knows where that is, one further in how far the surface is.
    const bool outline = std::abs(intersection.clearance_m) < width;
    if (!inside && !outline) continue;
    DrillStep slope;
    for (int p = 0; p < kDrillParameters; ++p) {
      const SolidIntersection there =
          moved[static_cast<std::size_t>(p)].IntersectWithDepth(ray, kReach_m);
      const double change = outline ? (there.clearance_m - intersection.clearance_m) / width
                                    : (there.range_m - intersection.range_m) / sigma;
      const bool same = there.part == intersection.part && there.Hits() == inside;
      slope[p] = same || (outline && there.part == intersection.part)
                     ? change / steps[static_cast<std::size_t>(p)]
                     : 0.0;
    }
    information += slope * slope.transpose();
  }
  information *= std::min(1.0, rays.samples_per_ray);
  DrillStep before = DrillStep::Ones();
  before[kDrillZ] = 1.0 / Squared(prior.height_sigma_m);
  before[kDrillYaw] = 0.1;
  before[kDrillScale] = 1.0 / Squared(prior.scale_sigma);
  before[kDrillTiltX] = before[kDrillTiltY] = 1.0 / Squared(prior.tilt_sigma_rad);
  before[kDrillBit] = 1.0 / Squared(0.1);
  before[kDrillHeadUp] = 1.0 / Squared(prior.head_up_sigma_m);
  before[kDrillHeadForward] = 1.0 / Squared(prior.head_forward_sigma_m);
  before[kDrillFoot] = 1.0 / Squared(prior.foot_sigma);
  information.diagonal() += before;
  return information;
}

void SetSigmas(const DrillInformation& information, const DrillState& drill,
               DrillDetection& detection) {
  using Matrix = DrillInformation;
  const Matrix covariance = information.ldlt().solve(Matrix::Identity());
  // From the table's frame to the object's own axes; its tilt is the table's, which is level.
  constexpr double kTableTiltSigma_rad = 0.01;
  Eigen::Matrix<double, 6, kDrillParameters> to_pose =
      Eigen::Matrix<double, 6, kDrillParameters>::Zero();
  const Eigen::AngleAxisd turn(-drill.yaw(), Eigen::Vector3d::UnitZ());
  to_pose.topLeftCorner<3, 3>() = turn.toRotationMatrix();
  to_pose(5, kDrillYaw) = 1.0;
  detection.covariance = to_pose * covariance * to_pose.transpose();
  detection.covariance(3, 3) += Squared(kTableTiltSigma_rad);
  detection.covariance(4, 4) += Squared(kTableTiltSigma_rad);
  detection.sigma_position_m = detection.covariance.diagonal().head<3>().cwiseMax(0.0).cwiseSqrt();
  detection.sigma_yaw_rad = std::sqrt(std::max(0.0, covariance(kDrillYaw, kDrillYaw)));
  detection.sigma_axis_rad = std::sqrt(
      std::max({0.0, covariance(kDrillTiltX, kDrillTiltX), covariance(kDrillTiltY, kDrillTiltY)}) +
      Squared(kTableTiltSigma_rad));
}

std::vector<std::string> DrillFeatureNames() {
  return {"log_yaw_margin",
          "log_head",
          "log_alternative_margin",
          "alternative_margin_per_hit",
          "gain_per_hit",
          "inlier_ratio",
          "see_through",
          "log_hits",
          "log_sigma_yaw",
          "abs_log_scale",
          "body_tilt_rad"};
}

Verdict AssessDrill(const RaySet& rays, const RaySet& region, const DrillDetection& detection,
                    const DrillState& drill, const DrillPrior& prior) {
  const VerdictModel& model = ShippedVerdictModel("drill", VerdictSourceOf(rays));
  Verdict verdict;
  verdict.features = FeaturesOf(rays, detection);
  verdict.probability = model.Probability(verdict.features);
  verdict.failed_gates = FailedGates(rays, region, detection, drill, prior);
  model.AddReservation(verdict.failed_gates);
  verdict.level = LevelFor(verdict.probability, !verdict.failed_gates.empty());
  verdict.reason = ReasonOf(
      verdict, Verdict::kLikely,
      fmt::format("{} beams on the drill, {:.0f} % of them agree; the other way fits worse",
                  detection.evidence.hits, 100.0 * detection.evidence.inlier_ratio),
      WeightiestFirst(model, verdict.features, FeatureGates(detection, model)));
  return verdict;
}

}  // namespace foresight
