#pragma once

#include <functional>
#include <memory>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// Another population's scenes, looked at in another way.
class RemeasuredPopulation : public FitPopulation {
 public:
  /// `change` alters a scene, whose seed it gets, but neither the thing in it nor what is true of
  /// it.
  using Change = std::function<void(std::uint64_t seed, FitTrialScene& scene)>;

  RemeasuredPopulation(std::unique_ptr<FitPopulation> population, FitWorld world, Change change)
      : population_(std::move(population)), world_(world), change_(std::move(change)) {}

  ObjectKind Kind() const override { return population_->Kind(); }
  FitWorld World() const override { return world_; }
  FitTrialScene MakeScene(std::uint64_t seed) const override {
    FitTrialScene scene = population_->MakeScene(seed);
    change_(seed, scene);
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
  FitWorld world_;
  Change change_;
};

}  // namespace foresight
