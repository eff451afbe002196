#include "core/evaluation/varied_world.h"

#include <cmath>

#include "core/evaluation/remeasured_population.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr std::uint64_t kConditionStream = 0x7661726965640001;
constexpr double kDrawn = 0.6;  ///< of the scenes, for each condition

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
    trial.region = random.Chance(0.5) ? FitTrialScene::Region::kRectangle
                                      : FitTrialScene::Region::kTightBox;
}

}  // namespace

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
    trial.rig_error = CalibrationError{RadiansFromDegrees(random.Uniform(0.0, 0.15)),
                                       random.Uniform(0.0, 0.004)};
  DrawRegion(random, trial);
  if (random.Chance(0.1)) trial.scanned = random.Uniform(0.5, 0.95);
}

std::unique_ptr<FitPopulation> MakeVaried(std::unique_ptr<FitPopulation> population) {
  return std::make_unique<RemeasuredPopulation>(
      std::move(population), FitWorld::kVaried, [](std::uint64_t seed, FitTrialScene& trial) {
        Random random(seed, kConditionStream);
        DrawConditions(random, trial);
      });
}

}  // namespace foresight
