#include "core/evaluation/varied_world.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/evaluation/remeasured_population.h"
#include "core/geometry/angles.h"
#include "core/simulation/shapes.h"

namespace foresight {
namespace {

constexpr std::uint64_t kConditionStream = 0x7661726965640001;
constexpr double kDrawn = 0.8;  ///< of the scenes, for each condition
constexpr double kChangedMaterial = 0.25;
constexpr double kOccluded = 0.4;

/// Between low and high, evenly in its logarithm.
double LogUniform(double low, double high, Random& random) {
  return low * std::pow(high / low, random.Uniform());
}

void DrawLidar(Random& random, LidarNoise& lidar) {
  if (random.Chance(kDrawn)) {
    lidar.footprint_horizontal_rad *= LogUniform(0.5, 2.0, random);
    lidar.footprint_vertical_rad *= LogUniform(0.5, 2.0, random);
    lidar.footprint_side = 4;
    if (random.Chance(0.5)) lidar.footprint = LidarNoise::Footprint::kGaussian;
  }
  if (random.Chance(kDrawn)) {
    lidar.pulse_length_m = LogUniform(0.06, 1.2, random);
    lidar.leading_edge = random.Uniform(0.0, 0.6);
  }
  if (random.Chance(kDrawn)) {
    lidar.sigma_base_m = LogUniform(0.004, 0.024, random);
    lidar.sigma_per_metre = random.Uniform(0.0, 0.002);
    lidar.sigma_at_threshold_m = LogUniform(0.004, 0.040, random);
    lidar.tail_degrees = 3 + random.Index(6);
    lidar.spurious_fraction = LogUniform(0.0002, 0.005, random);
  }
  if (random.Chance(kDrawn)) {
    lidar.walk_at_threshold_m = random.Uniform(0.0, 0.015);
    lidar.walk_of_black_m = random.Uniform(0.0, 0.015);
  }
}

void DrawRegion(Random& random, FitTrialScene& trial) {
  if (random.Chance(kDrawn))
    trial.region =
        random.Chance(0.5) ? FitTrialScene::Region::kRectangle : FitTrialScene::Region::kTightBox;
}

void ChangeMaterial(Random& random, Material& material) {
  const double kind = random.Uniform();
  if (kind < 0.4) {
    const double left = LogUniform(0.08, 0.4, random);
    material.lidar_reflectance *= left;
    material.color *= left;
    material.color2 *= left;
  } else if (kind < 0.8) {
    material.specular = random.Uniform(0.25, 0.8);
  } else {
    material.translucency = random.Uniform(0.03, 0.3);
    material.penetration_m = random.Uniform(0.0, 0.006);
  }
}

/// A bar of two to five straight pieces past the thing, nearer to the head: a cable, a branch, an
/// arm.
SceneMesh Occluder(const FitTrialScene& trial, Random& random) {
  const Eigen::Vector3d head = DefaultSensorRig().robot_from_base.translation();
  const Eigen::Vector3d towards = (head - trial.focus_m).normalized();
  const Eigen::Vector3d side = towards.unitOrthogonal();
  const Eigen::Vector3d other_side = towards.cross(side);
  const double turn = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const Eigen::Vector3d along = std::cos(turn) * side + std::sin(turn) * other_side;
  const Eigen::Vector3d across = towards.cross(along);
  SceneMesh mesh;
  mesh.name = "bar in front";
  mesh.material.lidar_reflectance = random.Uniform(0.05, 0.8);
  mesh.material.color.setConstant(random.Uniform(0.05, 0.9));
  const double radius_m = LogUniform(0.002, 0.030, random);
  const double piece_m = random.Uniform(0.15, 0.35);
  const int pieces = 2 + random.Index(4);
  Eigen::Vector3d from = trial.focus_m + random.Uniform(0.04, 0.35) * towards -
                         0.5 * pieces * piece_m * along +
                         random.Uniform(-1.0, 1.0) * trial.focus_radius_m * across;
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector3d to = from + piece_m * along + random.Uniform(-0.1, 0.1) * across +
                               random.Uniform(-0.03, 0.03) * towards;
    AppendShape(CapsuleShape(radius_m, (to - from).norm()),
                Rigid<frame::Robot, frame::Object>() * PoseAlong(from, to), mesh);
    from = to;
  }
  return mesh;
}

/// The scene with some materials changed, and what hides a part of it.
std::shared_ptr<const Scene> Changed(const FitTrialScene& trial, Random& random) {
  auto scene = std::make_shared<Scene>(*trial.scene);
  for (SceneMesh& mesh : scene->meshes)
    if (random.Chance(kChangedMaterial)) ChangeMaterial(random, mesh.material);
  if (random.Chance(kOccluded)) scene->meshes.push_back(Occluder(trial, random));
  return scene;
}

void DrawConditions(Random& random, FitTrialScene& trial) {
  DrawLidar(random, trial.world.lidar);
  if (random.Chance(kDrawn)) {
    const double times = random.Uniform(0.0, 2.5);
    MotorNoise& motor = trial.world.motor;
    motor.amplitude1_rad *= times;
    motor.amplitude2_rad *= times;
    motor.amplitude50_rad *= times;
    motor.backlash_rad *= times;
  }
  if (random.Chance(kDrawn))
    trial.rig_error =
        CalibrationError{RadiansFromDegrees(random.Uniform(0.0, 0.15)), random.Uniform(0.0, 0.004)};
  DrawRegion(random, trial);
  if (random.Chance(0.1)) trial.scanned = random.Uniform(0.5, 0.95);
  trial.scene = Changed(trial, random);
}

}  // namespace

std::unique_ptr<FitPopulation> MakeVaried(std::unique_ptr<FitPopulation> population) {
  return std::make_unique<RemeasuredPopulation>(std::move(population), FitWorld::kVaried,
                                                [](std::uint64_t seed, FitTrialScene& trial) {
                                                  Random random(seed, kConditionStream);
                                                  DrawConditions(random, trial);
                                                });
}

}  // namespace foresight
