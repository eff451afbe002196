#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A random scene of TerrainPopulation; the same seed gives the same scene.
FitTrialScene RandomTerrainScene(std::uint64_t seed);

}  // namespace foresight
