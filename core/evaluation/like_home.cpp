#include "core/evaluation/like_home.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/evaluation/remeasured_population.h"

namespace foresight {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"rig",   "walk",  "pulse",  "footprint",
                                                    "noise", "motor", "region", "interrupted"};

void Reset(OtherCondition condition, FitTrialScene& trial) {
  const LidarNoise home;
  LidarNoise& lidar = trial.world.lidar;
  switch (condition) {
    case OtherCondition::kRig:
      trial.rig_error.reset();
      break;
    case OtherCondition::kWalk:
      lidar.walk_at_threshold_m = home.walk_at_threshold_m;
      lidar.walk_of_black_m = home.walk_of_black_m;
      break;
    case OtherCondition::kPulse:
      lidar.pulse_length_m = home.pulse_length_m;
      lidar.leading_edge = home.leading_edge;
      break;
    case OtherCondition::kFootprint:
      lidar.footprint_horizontal_rad = home.footprint_horizontal_rad;
      lidar.footprint_vertical_rad = home.footprint_vertical_rad;
      lidar.footprint = home.footprint;
      break;
    case OtherCondition::kNoise:
      lidar.sigma_base_m = home.sigma_base_m;
      lidar.sigma_per_metre = home.sigma_per_metre;
      lidar.sigma_at_threshold_m = home.sigma_at_threshold_m;
      lidar.tail_degrees = home.tail_degrees;
      lidar.spurious_fraction = home.spurious_fraction;
      break;
    case OtherCondition::kMotor:
      trial.world.motor = MotorNoise();
      break;
    case OtherCondition::kRegion:
      trial.region = FitTrialScene::Region::kCircle;
      break;
    case OtherCondition::kInterrupted:
      trial.scanned = 1.0;
      break;
  }
}

}  // namespace

std::vector<std::string> OtherConditionNames() {
  return {kNames.begin(), kNames.end()};
}

Result<OtherCondition> OtherConditionFromString(const std::string& name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end())
    return Fail(ErrorCode::kInvalidOptions, "condition '{}' is none of {}", name,
                fmt::join(kNames, ", "));
  return static_cast<OtherCondition>(found - kNames.begin());
}

std::unique_ptr<FitPopulation> MakeLikeHome(std::unique_ptr<FitPopulation> population,
                                            std::vector<OtherCondition> conditions) {
  const FitWorld world = population->World();
  return std::make_unique<RemeasuredPopulation>(
      std::move(population), world,
      [conditions = std::move(conditions)](std::uint64_t, FitTrialScene& scene) {
        for (const OtherCondition condition : conditions) Reset(condition, scene);
      });
}

}  // namespace foresight
