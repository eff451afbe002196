#include "core/evaluation/simulated_trial.h"

#include <cmath>
#include <limits>

#include "core/geometry/angles.h"
#include "core/registration/register_scan.h"
#include "core/simulation/noise_stream.h"
#include "core/simulation/simulate_scan.h"

namespace foresight {
namespace {

Eigen::Vector3d RandomDirection(Random& random) {
  for (;;) {
    const Eigen::Vector3d direction(random.Normal(), random.Normal(), random.Normal());
    if (direction.norm() > 1e-3) return direction.normalized();
  }
}

}  // namespace

Status CalibrationError::Check() const {
  if (!(rotation_rad >= 0.0 && rotation_rad <= RadiansFromDegrees(10.0)))
    return Fail(ErrorCode::kInvalidOptions,
                "calibration error: rotation of {} deg is not in [0, 10]",
                DegreesFromRadians(rotation_rad));
  if (!(translation_m >= 0.0 && translation_m <= 0.1))
    return Fail(ErrorCode::kInvalidOptions,
                "calibration error: translation of {} mm is not in [0, 100]",
                1000.0 * translation_m);
  return {};
}

SensorRig MiscalibratedRig(const SensorRig& true_rig, const CalibrationError& error,
                           std::uint64_t seed) {
  Random random = NoiseStream(seed, NoisePurpose::kCalibrationError);
  const Eigen::AngleAxisd turn(error.rotation_rad, RandomDirection(random));
  const Eigen::Vector3d shift = error.translation_m * RandomDirection(random);
  SensorRig rig = true_rig;
  rig.camera_from_lidar = {turn * true_rig.camera_from_lidar.rotation(),
                           true_rig.camera_from_lidar.translation() + shift};
  return rig;
}

ScanPlan SimulatedTrialPlan() {
  ScanPlan plan;
  plan.from_rad = RadiansFromDegrees(-40.0);
  plan.to_rad = RadiansFromDegrees(20.0);
  plan.speed_rad_s = RadiansFromDegrees(10.0);
  plan.image_angles_rad = {RadiansFromDegrees(-10.0)};
  return plan;
}

Status SimulatedTrialOptions::Check() const {
  FORESIGHT_CHECK(plan.Check());
  if (plan.from_rad > plan.to_rad)
    return Fail(ErrorCode::kInvalidOptions,
                "simulated trial: the truth is of an upward sweep, not of {:.1f} to {:.1f} deg",
                DegreesFromRadians(plan.from_rad), DegreesFromRadians(plan.to_rad));
  FORESIGHT_CHECK(world.Check());
  FORESIGHT_CHECK(true_rig.Check());
  return calibration_error.Check();
}

Result<DepthImage> TruthSeenByLidar(const World& world, double image_rad, const ScanPlan& plan,
                                    const RunContext& context) {
  DepthImage truth_m = world.TrueDepth(image_rad, context);
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the true depth was cancelled");
  const MaskImage seen = world.SeenByLidar(truth_m, image_rad, plan.from_rad, plan.to_rad, context);
  if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the true depth was cancelled");
  for (std::size_t i = 0; i < truth_m.size(); ++i)
    if (seen.values()[i] == 0) truth_m.values()[i] = std::numeric_limits<float>::quiet_NaN();
  return truth_m;
}

Result<SimulatedTrial> MakeSimulatedTrial(std::shared_ptr<const Scene> scene,
                                          const SimulatedTrialOptions& options,
                                          const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  const World world(std::move(scene), options.true_rig, options.world);
  FORESIGHT_TRY(Scan scan, SimulateScan(world, options.plan, context.Part(0.0, 0.8)));
  scan.rig = MiscalibratedRig(scan.rig, options.calibration_error, options.world.seed);
  SimulatedTrial trial;
  trial.scene = world.scene().name;
  trial.rig = scan.rig;
  FORESIGHT_TRY(trial.cloud, RegisterScan(scan, context.Part(0.8, 0.9)));
  trial.frame = std::move(scan.frames.front());
  FORESIGHT_TRY(trial.truth_m, TruthSeenByLidar(world, options.plan.image_angles_rad.front(),
                                                options.plan, context.Part(0.9, 1.0)));
  return trial;
}

Result<ScoredDepth> RunOnTrial(const SimulatedTrial& trial, const DepthOptions& options,
                               const RunContext& context) {
  ScoredDepth scored;
  FORESIGHT_TRY(scored.result,
                ComputeDepthInFrame(trial.cloud, trial.rig, trial.frame, options, context));
  FORESIGHT_TRY(scored.score,
                ScoreMethod(trial.scene, options.method, scored.result, trial.truth_m, 1));
  return scored;
}

Result<MethodScore> EvaluateOnTrial(const SimulatedTrial& trial, const DepthOptions& options,
                                    const RunContext& context) {
  FORESIGHT_TRY(ScoredDepth scored, RunOnTrial(trial, options, context));
  return std::move(scored.score);
}

}  // namespace foresight
