#pragma once

#include <cstdint>
#include <vector>

#include "core/evaluation/verdict_fit.h"

namespace foresight {

/// Forty answers of home, every other one right, with one feature that grows with the seed.
inline std::vector<FitOutcome> HalfRightOutcomes() {
  std::vector<FitOutcome> outcomes(40);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    outcomes[i].found = true;
    outcomes[i].all_ok = i % 2 == 0;
    outcomes[i].seed = i;
    outcomes[i].verdict.features = {static_cast<double>(i)};
  }
  return outcomes;
}

/// To fit a valve's verdict to that feature.
inline VerdictFitOptions OneFeature() {
  VerdictFitOptions options;
  options.object = "valve";
  options.features = {"one"};
  return options;
}

}  // namespace foresight
