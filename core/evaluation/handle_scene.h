#pragma once

#include "core/evaluation/fit_trial.h"

namespace foresight {

/// A door with a handle, or with something else on it; what is drawn: handle_population.h.
FitTrialScene RandomHandleScene(std::uint64_t seed);

}  // namespace foresight
