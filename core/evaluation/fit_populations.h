#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// "valve", "drill", "terrain", "handle": the objects whose fits can be tried.
std::vector<std::string> FitPopulationKinds();

/// Fails with kInvalidOptions, listing the kinds there are.
Result<std::unique_ptr<FitPopulation>> MakeFitPopulation(const std::string& kind,
                                                         FitWorld world = FitWorld::kHome);

}  // namespace foresight
