#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// What differs between the other world's scans and those at home, beside what stands in a scene
/// (SetOtherConditions).
enum class OtherCondition {
  kRig,        ///< the believed rig is off
  kWalk,       ///< range walk of weak and of black returns
  kPulse,      ///< its length, and where in it the range is taken
  kFootprint,  ///< its size and how its light is spread
  kNoise,      ///< of the ranges, its tails, and returns from nowhere
  kMotor,
  kRegion,       ///< rectangles and tight boxes
  kInterrupted,  ///< scans
};
/// "rig", "walk", "pulse", "footprint", "noise", "motor", "region", "interrupted".
std::vector<std::string> OtherConditionNames();
/// Fails with kInvalidOptions, listing the names.
Result<OtherCondition> OtherConditionFromString(const std::string& name);

/// A population whose scenes stay as they are drawn, but for some conditions, which are what they
/// are at home: to see what each costs. It judges only, as the other world does.
std::unique_ptr<FitPopulation> MakeLikeHome(std::unique_ptr<FitPopulation> population,
                                            std::vector<OtherCondition> conditions);

}  // namespace foresight
