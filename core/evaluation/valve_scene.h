#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A random scene of ValvePopulation; the same seed gives the same scene.
FitTrialScene RandomValveScene(std::uint64_t seed);

}  // namespace foresight
