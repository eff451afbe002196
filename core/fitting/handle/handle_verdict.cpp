#include "core/fitting/handle/handle_verdict.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/squared.h"
#include "core/fitting/beam_model.h"
#include "core/fitting/common_gates.h"
#include "core/fitting/compressed_nats.h"
#include "core/fitting/gate.h"
#include "core/fitting/line_covariance.h"
#include "core/fitting/ray_selection.h"
#include "core/fitting/verdict_model.h"
#include "core/fitting/wall.h"

namespace foresight {
namespace {

constexpr double kOnHandle = 0.5;  // fraction of a footprint
constexpr int kCoverBins = 8;      // along the lever
constexpr double kRound_m = 0.03;  // beside the handle

// What no beam tells, that handles are no template and a door no plane, along and about x, y and z,
// and of the length: a factor on what the beams say, and what is added to it, as errors hardly grow
// with what the beams say but for the door's normal. Chosen so that the spreads over predicted that
// packaging/refit-verdicts prints of its training scenes are near 1 (docs/evaluation/handle.md,
// "The door again" and "A lever that goes on behind its pivot").
constexpr std::array<double, 6> kSigmaFactors = {1.0, 5.2, 1.0, 2.0, 2.8, 1.0};
constexpr std::array<double, 6> kSigmaAdded = {0.0035, 0.0018, 0.0060, 0.0, 0.0, 0.019};  // m, rad
constexpr double kLengthAdded_m = 0.0075;

constexpr const char* kObject = "the handle";
constexpr double kMinHits = 12.0;  // independent measurements on the handle
// Against a lever that points the other way: 100 : 1, and 2 : 1 of what is LIKELY.
constexpr double kMinMirror_nats = 4.6;
constexpr double kLeastMirror_nats = 0.7;
constexpr double kLongestBar_m = 0.195;   // of what counts as a lever: 205 mm with both its ends
constexpr double kLeastAhead_nats = 5.0;  // of another thing: 150 : 1, of what is LIKELY
// Where the lever is on a long plate the other thing was given it: a strip lies across the end of a
// bar by chance once in 22000.
constexpr double kStripByChance_nats = 10.0;

// CONFIRMED is wrong once in 70 answers at most. Of those that the probability and the gates would
// have confirmed on training scenes, by weights that had not seen the scene, 7 of 562 were wrong,
// but of those of fresh scenes of the other world 8 of 73 (docs/evaluation/handle.md, "Levers that
// bend").
constexpr const char* kNotYet =
    "a door handle is never confirmed yet: of answers as sure as that too many were wrong on "
    "scenes that were drawn to find out";

double RangeOf(const RaySet& rays, const HandleDetection& detection) {
  return (detection.best.base_from_object.translation() - rays.viewpoint).norm();
}

std::vector<double> FeaturesOf(const RaySet& rays, const HandleDetection& detection,
                               double proportions_nats) {
  const HandleEvidence& evidence = detection.evidence;
  const double hits = std::max(1.0, rays.Measured().Worth() * evidence.hits);
  return {evidence.mirror_margin_nats,
          Compressed(evidence.length_margin_nats),
          Compressed(evidence.alternative_margin_nats),
          evidence.gain_nats / hits,
          evidence.inlier_ratio,
          evidence.see_through,
          evidence.covered,
          evidence.beside,
          std::log(hits),
          std::log(std::max(1e-3, detection.beam_sigma_turn_rad)),
          std::abs(std::log(detection.best.model.length_m / HandlePrior::kLength_m)),
          proportions_nats,
          std::log(std::max(1e-3, detection.sigma_normal_rad)),
          evidence.outline_nats_per_px,
          std::log(std::max(1e-4, detection.line_sigma_pivot_m)),
          RangeOf(rays, detection)};
}

Gate MirrorGate(const HandleEvidence& evidence, double limit_nats) {
  return {.what = "the odds against a lever that points the other way are {}",
          .unit = Gate::Unit::kOdds,
          .number = evidence.mirror_margin_nats,
          .limit = limit_nats};
}

Eigen::Vector3d MiddleOf(const HandleCandidate& handle) {
  return handle.base_from_object * Eigen::Vector3d(0.5 * handle.model.length_m, 0.0, 0.0);
}

/// Why the handle is not even LIKELY.
std::vector<std::string> FailedExistenceGates(const HandleDetection& detection) {
  const HandleEvidence& evidence = detection.evidence;
  const bool on_strip = detection.best.model.plate == HandleModel::Plate::kLong;
  std::vector<std::string> failed;
  AddIfFailed(AlternativeGate(evidence.best_alternative, evidence.alternative_margin_nats,
                              kLeastAhead_nats - (on_strip ? kStripByChance_nats : 0.0)),
              failed);
  AddIfFailed(MirrorGate(evidence, kLeastMirror_nats), failed);
  return failed;
}

/// What speaks against the handle.
std::vector<std::string> FailedGates(const RaySet& region, const HandleDetection& detection,
                                     const FitHandleOptions& options) {
  constexpr double kBound_m = 0.002;
  const HandleEvidence& evidence = detection.evidence;
  std::vector<std::string> failed;
  AddIfFailed(MeasurementsGate(kObject, region.Measured().Worth() * evidence.hits, kMinHits),
              failed);
  AddIfFailed(SeeThroughGate(kObject, evidence.see_through, kMaxSeeThrough), failed);
  AddIfFailed(MirrorGate(evidence, kMinMirror_nats), failed);
  AddIfFailed({.what = "by where the door ends the odds for the way it points are {}",
               .unit = Gate::Unit::kOdds,
               .number = evidence.edges_nats,
               .advice = "handles point away from the nearest edge"},
              failed);
  AddIfFailed(OffCenterGate(kObject, region, MiddleOf(detection.best)), failed);
  AddIfOutside({.what = "its lever is {} long",
                .unit = Gate::Unit::kLength,
                .number = detection.best.model.length_m,
                .advice = "at the end of the range of lengths nothing is confirmed"},
               options.min_length_m + kBound_m, options.max_length_m - kBound_m, failed);
  AddIfFailed({.what = "its bar is {} long",
               .unit = Gate::Unit::kLength,
               .number = detection.best.model.length_m + detection.best.model.behind_m +
                         detection.best.model.radius_m,
               .side = Gate::Side::kAtMost,
               .limit = kLongestBar_m,
               .advice = "longer ones are pull bars more often than levers"},
              failed);
  return failed;
}

/// What may be unusual about it.
std::vector<FeatureGate> FeatureGates(const RaySet& region, const HandleDetection& detection,
                                      const VerdictModel& model) {
  const HandleEvidence& evidence = detection.evidence;
  const auto mean = [&](const char* feature) { return MeanOf(model, feature); };
  const auto usual_nats = [&](const char* feature) { return UsualNatsOf(model, feature); };
  return {{"inlier_ratio", AgreementGate(kObject, evidence.inlier_ratio, mean("inlier_ratio"))},
          {"see_through", SeeThroughGate(kObject, evidence.see_through, mean("see_through"))},
          {"covered",
           {.what = "{} of the lever's length has measurements that agree",
            .unit = Gate::Unit::kFraction,
            .number = evidence.covered,
            .limit = mean("covered")}},
          {"beside",
           {.what = "{} of the beams beside the handle end before the door",
            .unit = Gate::Unit::kFraction,
            .number = evidence.beside,
            .side = Gate::Side::kAtMost,
            .limit = mean("beside")}},
          {"log_sigma_turn",
           {.what = "its beams know its direction to {}",
            .unit = Gate::Unit::kAngle,
            .number = detection.beam_sigma_turn_rad,
            .side = Gate::Side::kAtMost,
            .limit = std::exp(mean("log_sigma_turn"))}},
          {"log_sigma_pivot",
           {.what = "its beams know its place to {}",
            .unit = Gate::Unit::kLength,
            .number = detection.line_sigma_pivot_m,
            .side = Gate::Side::kAtMost,
            .limit = std::exp(mean("log_sigma_pivot"))}},
          {"range",
           {.what = "it is {} away",
            .unit = Gate::Unit::kLength,
            .number = RangeOf(region, detection),
            .side = Gate::Side::kAtMost,
            .limit = mean("range")}},
          {"mirror_margin", MirrorGate(evidence, mean("mirror_margin"))},
          {"log_length_margin",
           {.what = "the odds against a lever that is 20 mm or more shorter or longer are {}",
            .unit = Gate::Unit::kOdds,
            .number = evidence.length_margin_nats,
            .limit = usual_nats("log_length_margin")}},
          {"log_alternative_margin",
           AlternativeGate(evidence.best_alternative, evidence.alternative_margin_nats,
                           usual_nats("log_alternative_margin"))}};
}

/// Of the normal about the door's x and y, in the frame of the handle: what lies round the region
/// knows it best.
Eigen::Vector2d NormalSigmas(const BeamLikelihood& likelihood, const Plane& door,
                             const Rigid<frame::Object, frame::Base>& object_from_base) {
  constexpr double kFlatness_rad = 0.004;  // no door is a plane
  std::vector<Eigen::Vector2d> on_door;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  const RaySet* around = SurroundingBeams(likelihood.rays());
  const RaySet& rays = around != nullptr ? *around : likelihood.rays();
  for (const RangeRay& ray : rays.rays) {
    if (std::abs(door.Distance(ray.Point())) > BeamModel::kAgreeSigmas * likelihood.Sigma())
      continue;
    on_door.push_back((object_from_base * ray.Point()).head<2>());
    mean += on_door.back();
  }
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& at : on_door)
    squares += (at - mean / static_cast<double>(on_door.size())).cwiseAbs2();
  squares *= rays.Worth();
  const auto sigma = [&](double spread2) {
    return std::hypot(kFlatness_rad, likelihood.Sigma() / std::sqrt(std::max(spread2, 1e-4)));
  };
  return {sigma(squares.y()), sigma(squares.x())};
}

/// What the beams say about the parameters near the handle: of each agreeing beam the slope of
/// what it should read, in deviations, and how far off it is.
struct BeamSlopes {
  std::vector<RangeRay> rays;
  Eigen::MatrixXd slopes;     ///< (rays x parameters), 1 / parameter
  Eigen::VectorXd residuals;  ///< in deviations
};

BeamSlopes SlopesOf(const BeamLikelihood& likelihood, const HandleScorer& scorer,
                    const HandleState& handle, const Plane& door) {
  const std::array<double, kHandleParameters> steps = {0.002, 0.002, 0.02,  0.002, 0.004,
                                                       0.004, 0.004, 0.004, 0.001};
  std::vector<CoverBeam> moved;
  for (int p = 0; p < kHandleParameters; ++p) {
    HandleState state = handle;
    state.values[p] += steps[static_cast<std::size_t>(p)];
    moved.push_back(CoverBy(ThingOf(state.Model(), state.Pose(scorer.base_from_door))));
  }
  const CoverBeam here = CoverBy(ThingOf(handle.Model(), handle.Pose(scorer.base_from_door)));
  const RaySet& rays = likelihood.rays();
  BeamSlopes found;
  const auto most = static_cast<Eigen::Index>(rays.rays.size());
  found.slopes.resize(most, kHandleParameters);
  found.residuals.resize(most);
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const double door_m = RangeToPlane(rays.rays[i], door);
    const auto reading = [&](const CoverBeam& thing) {
      const auto expected = likelihood.Expect(i, thing);
      if (!expected) return ExpectedBeam{0.0, door_m, door_m, likelihood.Sigma(), false};
      return *expected;
    };
    const ExpectedBeam at = reading(here);
    const double residual = (rays.rays[i].range_m - at.range_m) / at.sigma_m;
    if (std::abs(residual) > BeamModel::kAgreeSigmas) continue;
    HandleStep slope;
    for (int p = 0; p < kHandleParameters; ++p)
      slope[p] = (reading(moved[static_cast<std::size_t>(p)]).range_m - at.range_m) /
                 (steps[static_cast<std::size_t>(p)] * at.sigma_m);
    if (slope.isZero()) continue;
    const auto row = static_cast<Eigen::Index>(found.rays.size());
    found.rays.push_back(rays.rays[i]);
    found.slopes.row(row) = slope.transpose();
    found.residuals[row] = residual;
  }
  found.slopes.conservativeResize(static_cast<Eigen::Index>(found.rays.size()), Eigen::NoChange);
  found.residuals.conservativeResize(static_cast<Eigen::Index>(found.rays.size()));
  return found;
}

/// Of what is built, and a ridge that bounds what no beam tells: a length to a metre.
HandleInformation PriorInformation() {
  HandleInformation prior = HandleInformation::Identity();
  prior(kHandleStandoff, kHandleStandoff) += 1.0 / Squared(HandlePrior::kStandoffSigma_m);
  prior(kHandleRadius, kHandleRadius) += 1.0 / Squared(HandlePrior::kRadiusSigma_m);
  prior(kHandleLength, kHandleLength) += 1.0 / Squared(HandlePrior::kLengthSigma_m);
  prior(kHandleBow, kHandleBow) += 1.0 / Squared(HandlePrior::kBowSigma_m);
  prior(kHandleLift, kHandleLift) += 1.0 / Squared(HandlePrior::kLiftSigma_m);
  prior(kHandleBehind, kHandleBehind) += 1.0 / Squared(HandlePrior::kBehindSigma_m);
  return prior;
}

/// The handle's own covariance: as independent beams would have it, and for lines that err
/// together. The beams behind a map count, or a map that comes alone.
struct HandleCovariances {
  HandleInformation of_beams, of_lines;
};

HandleCovariances CovariancesOf(const HandleScorer& scorer, const HandleState& handle,
                                const Plane& door) {
  const BeamLikelihood& likelihood = scorer.likelihood.Measured();
  const BeamSlopes beams = SlopesOf(likelihood, scorer, handle, door);
  const double worth = likelihood.rays().Worth();
  const HandleInformation prior = PriorInformation();
  const Eigen::MatrixXd information = worth * beams.slopes.transpose() * beams.slopes + prior;
  const Eigen::MatrixXd scores = std::sqrt(worth) * beams.residuals.asDiagonal() * beams.slopes;
  HandleCovariances found;
  found.of_beams = information.ldlt().solve(HandleInformation::Identity());
  found.of_lines = CovarianceClusteredByLine(beams.rays, scores, information, prior);
  return found;
}

}  // namespace

HandleEvidence GatherEvidence(const BeamLikelihood& of_region, const Plane& door,
                              const HandleCandidate& handle) {
  const BeamLikelihood& likelihood = of_region.Measured();
  const DoorThing thing = ThingOf(handle.model, handle.base_from_object);
  const CoverBeam cover = CoverBy(thing);
  const auto object_from_base = handle.base_from_object.Inverse();
  const RaySet& rays = likelihood.rays();
  HandleEvidence evidence;
  int agreeing = 0, behind = 0, round = 0, round_before = 0;
  double square_sum = 0.0;
  std::array<bool, kCoverBins> covered{};
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const RangeRay& ray = rays.rays[i];
    ++evidence.rays;
    const auto expected = likelihood.Expect(i, cover);
    if (!expected || expected->fraction < 0.02) {
      if (!thing.Intersect(ray, kRound_m)) continue;
      ++round;
      round_before +=
          ray.range_m < RangeToPlane(ray, door) - BeamModel::kAgreeSigmas * likelihood.Sigma();
      continue;
    }
    if (expected->fraction < kOnHandle) continue;
    ++evidence.hits;
    const double error = ray.range_m - expected->range_m;
    const double agree_m = BeamModel::kAgreeSigmas * expected->sigma_m;
    behind += error > agree_m;
    if (std::abs(error) > agree_m) continue;
    ++agreeing;
    square_sum += error * error;
    const Eigen::Vector3d at = object_from_base * (ray.origin + expected->object_m * ray.direction);
    const double place = at.x() / handle.model.length_m;
    const double beside_m = at.y() - HandleModel::BowAt(place) * handle.model.bow_m;
    if (std::abs(beside_m) < 2.0 * handle.model.radius_m && place >= 0.0 && place < 1.0)
      covered[static_cast<std::size_t>(place * kCoverBins)] = true;
  }
  const double hits = std::max(1, evidence.hits);
  evidence.inlier_ratio = agreeing / hits;
  evidence.see_through = behind / hits;
  evidence.rms_m = std::sqrt(square_sum / std::max(1, agreeing));
  evidence.covered =
      static_cast<double>(std::count(covered.begin(), covered.end(), true)) / kCoverBins;
  evidence.beside = round_before / static_cast<double>(std::max(1, round));
  return evidence;
}

void SetSigmas(const HandleScorer& scorer, const HandleState& handle, HandleDetection& detection) {
  const HandleCovariances own = CovariancesOf(scorer, handle, detection.door);
  // From the door's frame to the handle's own axes.
  Eigen::Matrix<double, 6, kHandleParameters> to_pose =
      Eigen::Matrix<double, 6, kHandleParameters>::Zero();
  const double turn = handle.values[kHandleTurn];
  to_pose.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-turn).toRotationMatrix();
  to_pose(2, kHandleStandoff) = 1.0;
  to_pose(5, kHandleTurn) = 1.0;
  detection.covariance = to_pose * own.of_lines * to_pose.transpose();
  const Eigen::Vector2d normal =
      NormalSigmas(scorer.likelihood, detection.door, detection.best.base_from_object.Inverse());
  detection.covariance(3, 3) += Squared(normal.x());
  detection.covariance(4, 4) += Squared(normal.y());
  for (int i = 0; i < 6; ++i) {
    const auto place = static_cast<std::size_t>(i);
    detection.covariance.row(i) *= kSigmaFactors[place];
    detection.covariance.col(i) *= kSigmaFactors[place];
    detection.covariance(i, i) += Squared(kSigmaAdded[place]);
  }
  const Eigen::Matrix<double, 6, 1> sigmas =
      detection.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  detection.sigma_position_m = sigmas.head<3>();
  detection.sigma_normal_rad = sigmas.segment<2>(3).maxCoeff();
  detection.sigma_turn_rad = sigmas[5];
  detection.sigma_length_m =
      std::sqrt(own.of_lines(kHandleLength, kHandleLength) + Squared(kLengthAdded_m));
  detection.line_sigma_pivot_m =
      std::sqrt(std::max(0.0, own.of_lines.topLeftCorner<2, 2>().trace() +
                                  own.of_lines(kHandleStandoff, kHandleStandoff)));
  detection.beam_sigma_turn_rad = std::sqrt(std::max(0.0, own.of_beams(kHandleTurn, kHandleTurn)));
}

std::vector<std::string> HandleFeatureNames() {
  return {"mirror_margin",
          "log_length_margin",
          "log_alternative_margin",
          "gain_per_hit",
          "inlier_ratio",
          "see_through",
          "covered",
          "beside",
          "log_hits",
          "log_sigma_turn",
          "abs_log_length",
          "proportions",
          "log_sigma_normal",
          "outline",
          "log_sigma_pivot",
          "range"};
}

Verdict AssessHandle(const RaySet& region, const HandleDetection& detection,
                     const FitHandleOptions& options, double proportions_nats) {
  constexpr const char* kInWords = "{} beams on the handle, {:.0f} % of them agree; {}";
  const HandleEvidence& evidence = detection.evidence;
  const auto in_words = [&](const char* rest) {
    return fmt::format(fmt::runtime(kInWords), evidence.hits, 100.0 * evidence.inlier_ratio, rest);
  };
  Verdict verdict;
  verdict.features = FeaturesOf(region, detection, proportions_nats);
  const std::vector<std::string> none = FailedExistenceGates(detection);
  verdict.failed_gates = none;
  for (std::string& gate : FailedGates(region, detection, options))
    verdict.failed_gates.push_back(std::move(gate));
  const VerdictModel* model = FindVerdictModel("handle", VerdictSourceOf(region));
  if (model == nullptr) {
    verdict.probability = std::nan("");
    verdict.level = verdict.failed_gates.empty() ? VerdictLevel::kLikely : VerdictLevel::kUnsure;
    verdict.reason = verdict.failed_gates.empty()
                         ? in_words("never confirmed, as no probability was calibrated for it")
                         : verdict.failed_gates.front();
    return verdict;
  }
  verdict.probability = model->Probability(verdict.features);
  model->AddReservation(verdict.failed_gates);
  if (!none.empty()) verdict.probability = BelowLikely(verdict.probability);
  verdict.level = LevelFor(verdict.probability, !verdict.failed_gates.empty());
  verdict.reason =
      ReasonOf(verdict, Verdict::kLikely, in_words("the other way fits worse"),
               WeightiestFirst(*model, verdict.features, FeatureGates(region, detection, *model)));
  if (verdict.level == VerdictLevel::kConfirmed) {
    verdict.level = VerdictLevel::kLikely;
    verdict.reason = kNotYet;
  }
  verdict.failed_gates.push_back(kNotYet);
  return verdict;
}

}  // namespace foresight
