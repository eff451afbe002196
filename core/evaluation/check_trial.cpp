#include "core/evaluation/check_trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"
#include "core/simulation/noise_stream.h"
#include "core/simulation/simulate_scan.h"

namespace foresight {
namespace {

Result<FitTrialScene> RandomScene(std::uint64_t seed, FitWorld world) {
  constexpr const char* kKinds[] = {"valve", "drill", "terrain"};
  FORESIGHT_TRY(const auto population, MakeFitPopulation(kKinds[seed % std::size(kKinds)], world));
  return population->MakeScene(seed);
}

void Add(double confidence, bool right, DepthCheckOutcome& outcome) {
  const int of_class = std::clamp(static_cast<int>(ConfidenceTruth::kClasses * confidence), 0,
                                  ConfidenceTruth::kClasses - 1);
  ConfidenceTruth& truth = outcome.confidence[static_cast<std::size_t>(of_class)];
  ++truth.pixels;
  truth.promised += confidence;
  truth.right += right ? 1 : 0;
}

}  // namespace

ScanPlan CheckTrialOptions::CheckPlan() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-30.0);
  plan.to_rad = RadiansFromDegrees(30.0);
  plan.speed_rad_s = RadiansFromDegrees(20.0);
  plan.image_angles_rad = {RadiansFromDegrees(-15.0), 0.0, RadiansFromDegrees(15.0)};
  plan.passes = 2;
  return plan;
}

std::vector<RigDamage> UsualDamages(double turn_rad, double stamp_s, double scale) {
  std::vector<RigDamage> damages = {{.name = "none"}};
  for (const bool camera : {true, false})
    for (int axis = 0; axis < 3; ++axis) {
      RigDamage damage{.name = fmt::format("{} turn {}", camera ? "camera" : "lidar", "xyz"[axis])};
      (camera ? damage.camera_turn_rad : damage.lidar_turn_rad)[axis] = turn_rad;
      damages.push_back(damage);
    }
  damages.push_back({.name = "stamps", .stamp_s = stamp_s});
  damages.push_back({.name = "motor scale", .motor_scale = scale});
  damages.push_back({.name = "motor harmonic", .motor_harmonic_rad = turn_rad});
  return damages;
}

Result<CheckTrial> MakeCheckTrial(std::shared_ptr<const Scene> scene, std::uint64_t seed,
                                  const CheckTrialOptions& options, const RunContext& context) {
  WorldOptions world_options;
  world_options.seed = seed;
  if (scene == nullptr) {
    FORESIGHT_TRY(const FitTrialScene random, RandomScene(seed, options.world));
    scene = random.scene;
    world_options = random.world;
  }
  World world(scene, DefaultSensorRig(), world_options);
  FORESIGHT_TRY(Scan scan, SimulateScan(world, options.plan, context));
  scan.rig = MiscalibratedRig(scan.rig, options.calibration_error, options.rig_seed.value_or(seed));
  return CheckTrial{seed, std::move(world), std::move(scan)};
}

Result<std::vector<CheckOutcome>> CheckDamages(const CheckTrial& trial,
                                               const std::vector<RigDamage>& damages,
                                               const CheckTrialOptions& options,
                                               const RunContext& context) {
  Scan scan = trial.scan;
  Random random =
      NoiseStream(options.rig_seed.value_or(trial.seed), NoisePurpose::kCalibrationError);
  std::vector<CheckOutcome> outcomes;
  for (RigDamage damage : damages) {
    CheckOutcome outcome;
    outcome.seed = trial.seed;
    outcome.scene = trial.world.scene().name;
    outcome.damage = damage.name;
    outcome.sign = random.Uniform() < 0.5 ? -1.0 : 1.0;
    damage.camera_turn_rad *= outcome.sign;
    damage.lidar_turn_rad *= outcome.sign;
    damage.stamp_s *= outcome.sign;
    damage.motor_scale *= outcome.sign;
    if (damage.motor_harmonic_rad != 0.0)
      damage.motor_phase_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
    scan.rig = RigBefore(damage, trial.scan.rig);
    const auto start = std::chrono::steady_clock::now();
    FORESIGHT_TRY(outcome.check, CheckRig(scan, options.check, context));
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

Result<DepthCheckOutcome> CheckDepthOfTrial(const CheckTrial& trial, const DepthOptions& depth,
                                            const DepthCheckOptions& options,
                                            const RunContext& context) {
  const Scan& scan = trial.scan;
  const CameraFrame* frame = NearestFrame(scan, 0.5 * (scan.plan.from_rad + scan.plan.to_rad));
  if (frame == nullptr) return Fail(ErrorCode::kInvalidInput, "the scan has no image");
  DepthCheckOutcome outcome;
  outcome.seed = trial.seed;
  outcome.scene = trial.world.scene().name;
  FORESIGHT_TRY(const RegisteredScan cloud, RegisterScan(scan, context));
  FORESIGHT_TRY(outcome.check, CheckDepth(cloud, scan.rig, *frame, depth, options, context));
  FORESIGHT_TRY(const DepthResult whole,
                ComputeDepthInFrame(cloud, scan.rig, *frame, depth, context));
  FORESIGHT_TRY(const DepthImage truth_m,
                TruthSeenByLidar(trial.world, frame->target_angle_rad, scan.plan, context));
  std::vector<double> errors_m;
  std::size_t right = 0;
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    const double truth = truth_m.values()[i];
    const double depth_m = whole.dense.depth_m.values()[i];
    if (std::isnan(truth) || std::isnan(depth_m)) continue;
    const double error = std::abs(depth_m - truth);
    const bool is_right = error <= RightWithin_m(truth);
    Add(whole.dense.confidence.values()[i], is_right, outcome);
    if (whole.mask.values()[i] == 0) continue;
    errors_m.push_back(error);
    right += is_right ? 1 : 0;
  }
  outcome.true_q50_m = Quantile(errors_m, 0.50);
  outcome.true_q80_m = Quantile(errors_m, 0.80);
  outcome.true_q95_m = Quantile(errors_m, 0.95);
  outcome.true_right = static_cast<double>(right) / static_cast<double>(errors_m.size());
  return outcome;
}

Result<std::vector<CheckOutcome>> RunCheckTrial(std::shared_ptr<const Scene> scene,
                                                std::uint64_t seed,
                                                const std::vector<RigDamage>& damages,
                                                const CheckTrialOptions& options,
                                                const RunContext& context) {
  FORESIGHT_TRY(const CheckTrial trial, MakeCheckTrial(std::move(scene), seed, options, context));
  return CheckDamages(trial, damages, options, context);
}

}  // namespace foresight
