#include "core/evaluation/like_home.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

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

class LikeHomePopulation : public FitPopulation {
 public:
  LikeHomePopulation(std::unique_ptr<FitPopulation> population,
                     std::vector<OtherCondition> conditions)
      : population_(std::move(population)), conditions_(std::move(conditions)) {}

  ObjectKind Kind() const override { return population_->Kind(); }
  FitWorld World() const override { return population_->World(); }
  FitTrialScene MakeScene(std::uint64_t seed) const override {
    FitTrialScene scene = population_->MakeScene(seed);
    for (const OtherCondition condition : conditions_) Reset(condition, scene);
    return scene;
  }
  FitOptions Options(const SensorRig& rig) const override { return population_->Options(rig); }
  std::vector<FitOutcome> Judge(const FitTrial& trial,
                                const Result<Detection>& found) const override {
    return population_->Judge(trial, found);
  }
  std::vector<std::string> FeatureNames() const override { return population_->FeatureNames(); }

 private:
  std::unique_ptr<FitPopulation> population_;
  std::vector<OtherCondition> conditions_;
};

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
  return std::make_unique<LikeHomePopulation>(std::move(population), std::move(conditions));
}

}  // namespace foresight
