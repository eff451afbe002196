#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A random scene of DrillPopulation; the same seed gives the same scene.
FitTrialScene RandomDrillScene(std::uint64_t seed);

}  // namespace foresight
