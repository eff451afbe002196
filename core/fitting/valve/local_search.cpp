#include "core/fitting/valve/local_search.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/fitting/valve/valve_coverage.h"

namespace foresight {
namespace {

constexpr int kRounds = 5;  // each halves the steps
constexpr int kPasses = 2;
constexpr double kFront =
    std::numbers::pi / 4.0;  // mean depth of an ellipse's front to its largest

ValveStep FirstSteps() {
  ValveStep steps;
  steps << 0.010, 0.010, 0.010, 0.052, 0.052, 0.052, 0.010, 0.003, 0.010, 0.400, 0.006, 0.003,
      0.004;
  return steps;
}

/// Whether a parameter changes nothing.
bool Blind(const ValveModel& model, int parameter) {
  if (model.IsLever()) return parameter >= kRimDepth;
  return model.spokes == 0 &&
         (parameter == kPhase || parameter == kSpokeRadius || parameter == kSpokeDepth);
}

/// Where a step may lead: along each parameter. A rim gets deeper with its front held still, which
/// is what the rays see. For a lever also with its far end held still, because a step of its pivot
/// alone would turn all of the bar off its returns.
std::vector<ValveStep> Directions(const ValveModel& model) {
  const ValveStep steps = FirstSteps();
  std::vector<ValveStep> directions;
  for (int p = 0; p < kValveParameters; ++p)
    if (!Blind(model, p)) directions.push_back(steps[p] * ValveStep::Unit(p));
  for (ValveStep& direction : directions) direction[kMoveZ] -= kFront * direction[kRimDepth];
  if (!model.IsLever()) return directions;
  const double length_m = std::max(model.lever_length_m, 0.05);
  const auto hold_end = [&](int move, int parameter, double change_per_m) {
    directions.push_back(steps[move] *
                         (ValveStep::Unit(move) + change_per_m * ValveStep::Unit(parameter)));
  };
  hold_end(kMoveX, kRimRadius, -1.0);
  hold_end(kMoveY, kPhase, -1.0 / length_m);
  hold_end(kMoveZ, kTiltY, 1.0 / length_m);
  return directions;
}

}  // namespace

ValveCandidate LocalSearch(const BeamLikelihood& likelihood, const ValveCandidate& start) {
  ValveCandidate best = start;
  const std::vector<ValveStep> directions = Directions(start.model);
  double scale = 1.0;
  for (int round = 0; round < kRounds; ++round, scale *= 0.5) {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (const ValveStep& direction : directions) {
        for (const double sign : {1.0, -1.0}) {
          ValveCandidate tried = Retract(best, sign * scale * direction);
          tried.log_likelihood = ScoreOf(tried, likelihood);
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
