#include "core/fitting/valve/polish.h"

namespace foresight {
namespace {

constexpr int kRounds = 5;  // each halves the steps
constexpr int kPasses = 2;

ValveStep FirstSteps() {
  ValveStep steps;
  steps << 0.010, 0.010, 0.010, 0.052, 0.052, 0.052, 0.010, 0.003, 0.010, 0.400;
  return steps;
}

/// Whether a parameter changes nothing.
bool Blind(const ValveModel& model, int parameter) {
  return model.IsLever() ? parameter == kDish : parameter == kPhase && model.spokes == 0;
}

}  // namespace

ValveCandidate Polish(const RayLikelihood& likelihood, const ValveCandidate& start) {
  ValveCandidate best = start;
  ValveStep steps = FirstSteps();
  for (int round = 0; round < kRounds; ++round, steps *= 0.5) {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (int p = 0; p < kValveParameters; ++p) {
        if (Blind(best.model, p)) continue;
        for (const double sign : {1.0, -1.0}) {
          ValveCandidate tried = Moved(best, sign * steps[p] * ValveStep::Unit(p));
          tried.log_likelihood = likelihood(tried);
          if (tried.log_likelihood > best.log_likelihood) {
            best = tried;
            break;
          }
        }
      }
    }
  }
  return best;
}

}  // namespace foresight
