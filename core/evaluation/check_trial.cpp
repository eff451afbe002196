#include "core/evaluation/check_trial.h"

#include <chrono>

#include "core/calibration/tangent.h"
#include "core/evaluation/drill_scene.h"
#include "core/evaluation/terrain_scene.h"
#include "core/evaluation/valve_scene.h"
#include "core/geometry/angles.h"
#include "core/simulation/noise_stream.h"
#include "core/simulation/simulate_scan.h"

namespace foresight {
namespace {

FitTrialScene RandomScene(std::uint64_t seed) {
  switch (seed % 3) {
    case 0:
      return RandomValveScene(seed);
    case 1:
      return RandomDrillScene(seed);
    default:
      return RandomTerrainScene(seed);
  }
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

std::vector<RigDamage> UsualDamages(double turn_rad, double stamp_s) {
  std::vector<RigDamage> damages = {{.name = "none"}};
  for (const bool camera : {true, false})
    for (int axis = 0; axis < 3; ++axis) {
      RigDamage damage{.name = fmt::format("{} turn {}", camera ? "camera" : "lidar", "xyz"[axis])};
      (camera ? damage.camera_turn_rad : damage.lidar_turn_rad)[axis] = turn_rad;
      damages.push_back(damage);
    }
  damages.push_back({.name = "stamps", .stamp_s = stamp_s});
  return damages;
}

SensorRig RigBefore(const RigDamage& damage, const SensorRig& true_rig) {
  const Eigen::Quaterniond camera = RotationExp(-damage.camera_turn_rad);
  const Eigen::Quaterniond lidar = RotationExp(-damage.lidar_turn_rad);
  SensorRig rig = true_rig;
  rig.camera_from_head = {camera * true_rig.camera_from_head.rotation(),
                          camera * true_rig.camera_from_head.translation()};
  rig.camera_from_lidar = {camera * true_rig.camera_from_lidar.rotation() * lidar,
                           camera * true_rig.camera_from_lidar.translation()};
  rig.lidar.stamp_offset_s -= damage.stamp_s;
  return rig;
}

Result<std::vector<CheckOutcome>> RunCheckTrial(std::shared_ptr<const Scene> scene,
                                                std::uint64_t seed,
                                                const std::vector<RigDamage>& damages,
                                                const CheckTrialOptions& options,
                                                const RunContext& context) {
  WorldOptions world_options;
  world_options.seed = seed;
  if (scene == nullptr) {
    FitTrialScene random = RandomScene(seed);
    scene = random.scene;
    world_options = random.world;
  }
  const World world(scene, DefaultSensorRig(), world_options);
  FORESIGHT_TRY(Scan scan, SimulateScan(world, options.plan, context));
  const SensorRig calibrated = MiscalibratedRig(scan.rig, options.calibration_error, seed);
  Random random = NoiseStream(seed, NoisePurpose::kCalibrationError);
  std::vector<CheckOutcome> outcomes;
  for (RigDamage damage : damages) {
    CheckOutcome outcome;
    outcome.seed = seed;
    outcome.scene = world.scene().name;
    outcome.damage = damage.name;
    outcome.sign = random.Uniform() < 0.5 ? -1.0 : 1.0;
    damage.camera_turn_rad *= outcome.sign;
    damage.lidar_turn_rad *= outcome.sign;
    damage.stamp_s *= outcome.sign;
    scan.rig = RigBefore(damage, calibrated);
    const auto start = std::chrono::steady_clock::now();
    FORESIGHT_TRY(outcome.check, CheckRig(scan, options.check, context));
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

}  // namespace foresight
