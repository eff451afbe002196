#include "core/selfcheck/depth_check.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/quantile.h"
#include "core/depth/depth_method.h"
#include "core/selfcheck/half_maps.h"
#include "core/selfcheck/map_errors.h"

namespace foresight {
namespace {

HeldOutErrors ErrorsOf(const std::vector<HeldOutBeam>& beams, const BeamChoice& choice) {
  return HeldOutErrorsOf(beams, [&](const HeldOutBeam& beam) { return beam.kept && choice(beam); });
}

bool Any(const HeldOutBeam&) {
  return true;
}

std::vector<HeldOutClass> ByDistance(const std::vector<HeldOutBeam>& beams) {
  constexpr double kFirst_m = 1.0, kLast_m = 64.0;
  std::vector<HeldOutClass> classes;
  const auto add = [&](const std::string& name, double from_m, double to_m) {
    HeldOutErrors errors = ErrorsOf(beams, [&](const HeldOutBeam& beam) {
      return beam.depth_m >= from_m && beam.depth_m < to_m;
    });
    if (errors.beams > 0) classes.push_back({name, errors});
  };
  add(fmt::format("below {:.0f} m", kFirst_m), 0.0, kFirst_m);
  for (double from_m = kFirst_m; from_m < kLast_m; from_m *= 2.0)
    add(fmt::format("{:.0f} to {:.0f} m", from_m, 2.0 * from_m), from_m, 2.0 * from_m);
  add(fmt::format("{:.0f} m and more", kLast_m), kLast_m, AlignedSamples::kFarthest_m);
  return classes;
}

std::vector<HeldOutClass> ByEdge(const std::vector<HeldOutBeam>& beams) {
  return {{"at edges", ErrorsOf(beams, [](const HeldOutBeam& beam) { return beam.at_edge; })},
          {"on surfaces", ErrorsOf(beams, [](const HeldOutBeam& beam) { return !beam.at_edge; })}};
}

ConfidenceClass ConfidenceOf(const std::vector<HeldOutBeam>& beams, const BeamChoice& choice,
                             double beams_per_measurement) {
  ConfidenceClass found;
  for (const HeldOutBeam& beam : beams) {
    if (std::isnan(beam.map_m) || !choice(beam)) continue;
    ++found.beams;
    found.promised += beam.confidence;
    found.right += beam.IsRight() ? 1.0 : 0.0;
  }
  if (found.beams == 0) return found;
  found.promised /= found.beams;
  found.right /= found.beams;
  const double measurements = std::max(1.0, found.beams / beams_per_measurement);
  // One right and one wrong more: all right of a few is no certainty.
  const double likely = (found.right * measurements + 1.0) / (measurements + 2.0);
  found.sigma = std::sqrt(likely * (1.0 - likely) / measurements);
  return found;
}

std::vector<ConfidenceClass> ByConfidence(const std::vector<HeldOutBeam>& beams,
                                          const DepthCheckOptions& options) {
  std::vector<ConfidenceClass> classes;
  double from = 0.0;
  for (const double to : {0.50, 0.65, 0.75, 0.85, 0.95, 1.01}) {
    ConfidenceClass found = ConfidenceOf(
        beams,
        [&](const HeldOutBeam& beam) { return beam.confidence >= from && beam.confidence < to; },
        options.beams_per_measurement);
    found.from = from;
    found.to = std::min(to, 1.0);
    if (found.beams > 0) classes.push_back(found);
    from = to;
  }
  return classes;
}

/// The noise of the map is told best by maps of half of the lines, and what lines share by those
/// that stayed out; but between these the map is worse than it is elsewhere.
double QuantileOfMap(const std::vector<double>& noise_m, const std::vector<NoisyError>& in_gaps,
                     double fraction) {
  // Chosen on the seeds of docs/self_check.md; 0.25 to 0.5 do as well.
  constexpr double kGaps = 0.4;
  const double gap_m = QuantileWithoutNoise(in_gaps, fraction);
  if (noise_m.empty()) return gap_m;
  const double quantile_m = Quantile(noise_m, fraction);
  if (in_gaps.empty()) return quantile_m;
  return std::sqrt((1.0 - kGaps) * quantile_m * quantile_m + kGaps * gap_m * gap_m);
}

DepthCheck::State StateOf(const DepthCheck& check, const DepthCheckOptions& options) {
  if (check.TooFewBeams() || check.promise.beams == 0) return DepthCheck::State::kNotSeen;
  const double shortfall = check.promise.promised - check.promise.right;
  if (shortfall < std::max(options.least_shortfall, options.sigmas * check.promise.sigma))
    return DepthCheck::State::kGood;
  return shortfall < options.red_shortfall ? DepthCheck::State::kLessThanPromised
                                           : DepthCheck::State::kFarLessThanPromised;
}

}  // namespace

HeldOutErrors HeldOutErrorsOf(const std::vector<HeldOutBeam>& beams, const BeamChoice& choice) {
  HeldOutErrors errors;
  std::vector<double> sizes;
  int right = 0;
  for (const HeldOutBeam& beam : beams) {
    if (std::isnan(beam.map_m) || !choice(beam)) continue;
    sizes.push_back(std::abs(beam.Error_m()));
    right += beam.IsRight() ? 1 : 0;
  }
  errors.beams = static_cast<int>(sizes.size());
  errors.q50_m = Quantile(sizes, 0.50);
  errors.q80_m = Quantile(sizes, 0.80);
  errors.q95_m = Quantile(sizes, 0.95);
  errors.right = errors.beams > 0 ? static_cast<double>(right) / errors.beams : std::nan("");
  return errors;
}

const char* ToString(DepthCheck::State state) {
  switch (state) {
    case DepthCheck::State::kGood:
      return "good";
    case DepthCheck::State::kLessThanPromised:
      return "less than promised";
    case DepthCheck::State::kFarLessThanPromised:
      return "far less than promised";
    case DepthCheck::State::kNotSeen:
      return "not seen";
  }
  return "";
}

Status DepthCheckOptions::Check() const {
  if (one_in < 2 || one_in > 1000)
    return Fail(ErrorCode::kInvalidOptions, "depth check: one_in {} is not in [2, 1000]", one_in);
  if (!(beams_per_measurement >= 1.0) || !(sigmas > 0.0))
    return Fail(ErrorCode::kInvalidOptions,
                "depth check: beams_per_measurement {} is below 1, or sigmas {} not above 0",
                beams_per_measurement, sigmas);
  return {};
}

DepthCheck SummariseHeldOut(const std::vector<HeldOutBeam>& scattered,
                            const std::vector<HeldOutBeam>& lines,
                            const std::vector<double>& noise_m, DepthMethod method,
                            const DepthCheckOptions& options) {
  DepthCheck check;
  check.method = InfoOf(method).name;
  std::vector<HeldOutBeam> both = scattered;
  both.insert(both.end(), lines.begin(), lines.end());
  check.left_out = static_cast<int>(both.size());
  check.all = ErrorsOf(both, Any);
  check.scattered = ErrorsOf(scattered, Any);
  check.lines = ErrorsOf(lines, Any);
  check.kept = both.empty() ? 0.0 : static_cast<double>(check.all.beams) / check.left_out;
  check.by_distance = ByDistance(both);
  check.by_edge = ByEdge(both);
  if (method == DepthMethod::kForesight) {
    check.by_confidence = ByConfidence(both, options);
    check.promise = ConfidenceOf(
        both, [](const HeldOutBeam& beam) { return beam.kept; }, options.beams_per_measurement);
    check.promise.to = 1.0;
  }
  const std::vector<NoisyError> errors = MapErrors(lines);
  check.map_q50_m = QuantileOfMap(noise_m, errors, 0.50);
  check.map_q80_m = QuantileOfMap(noise_m, errors, 0.80);
  check.map_q95_m = QuantileOfMap(noise_m, errors, 0.95);
  check.state = StateOf(check, options);
  return check;
}

Result<DepthCheck> CheckDepth(const RegisteredScan& cloud, const SensorRig& rig,
                              const CameraFrame& frame, const DepthOptions& depth,
                              const DepthCheckOptions& options, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_TRY(AlignedSamples aligned,
                AlignToImage(cloud, rig, frame.motor_angle_rad, context.Part(0.0, 0.1)));
  FORESIGHT_TRY(const JudgedBeams beams,
                JudgeBeams(std::move(aligned), depth, context.Part(0.1, 0.2)));
  HoldOutPlan plan;
  plan.one_in = options.one_in;
  plan.turn = options.one_in / 2;
  plan.together = 2;
  plan.pattern = HoldOutPlan::Pattern::kBoth;
  FORESIGHT_TRY(const DepthResult nearly_all,
                MapWithout(beams, frame.image, depth, plan, context.Part(0.2, 0.5)));
  plan.pattern = HoldOutPlan::Pattern::kScattered;
  FORESIGHT_TRY(const std::vector<HeldOutBeam> scattered, CompareWithMap(beams, nearly_all, plan));
  plan.pattern = HoldOutPlan::Pattern::kLines;
  FORESIGHT_TRY(const std::vector<HeldOutBeam> lines, CompareWithMap(beams, nearly_all, plan));
  FORESIGHT_TRY(const std::vector<double> noise_m,
                NoiseOfMap(beams, frame.image, depth, nearly_all.mask, context.Part(0.5, 1.0)));
  DepthCheck check = SummariseHeldOut(scattered, lines, noise_m, depth.method, options);
  check.image_rad = frame.motor_angle_rad;
  check.not_counted =
      static_cast<int>(std::count(beams.counts.begin(), beams.counts.end(), std::uint8_t{0}));
  check.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return check;
}

}  // namespace foresight
