#include "core/fitting/valve/spoke_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/parallel.h"
#include "core/fitting/valve/refine.h"
#include "core/fitting/valve/valve_coverage.h"

namespace foresight {
namespace {

constexpr double kFirstDish_m = -0.020;
constexpr double kDishStep_m = 0.020;
constexpr int kDishes = 6;
constexpr double kPhaseStep_rad = 0.1;

ValveCandidate BestOfGrid(const BeamLikelihood& likelihood, const ValveCandidate& rim, int spokes) {
  const double sector = spokes > 0 ? 2.0 * std::numbers::pi / spokes : 0.0;
  const int phases = std::max(1, static_cast<int>(std::ceil(sector / kPhaseStep_rad)));
  std::optional<ValveCandidate> best;
  for (int d = 0; d < kDishes; ++d) {
    for (int p = 0; p < phases; ++p) {
      ValveCandidate tried = Retract(rim, sector * p / phases * ValveStep::Unit(int{kPhase}));
      tried.model = UsualValve(rim.model.rim_radius_m, rim.model.tube_radius_m, spokes,
                               kFirstDish_m + d * kDishStep_m);
      tried.model.rim_depth_ratio = rim.model.rim_depth_ratio;
      tried.log_likelihood = ScoreOf(tried, likelihood);
      if (!best || tried.log_likelihood > best->log_likelihood) best = tried;
    }
  }
  return *best;
}

}  // namespace

Result<std::vector<ValveCandidate>> FindSpokes(const BeamLikelihood& coarse,
                                               const BeamLikelihood& fine,
                                               const std::vector<ValveCandidate>& rims,
                                               const std::vector<int>& spoke_counts,
                                               const RunContext& context) {
  if (rims.empty()) return std::vector<ValveCandidate>();
  const int jobs = static_cast<int>(rims.size() * spoke_counts.size());
  std::vector<ValveCandidate> refined(static_cast<std::size_t>(jobs));
  const bool finished = ParallelFor(jobs, context, [&](int job) {
    const auto index = static_cast<std::size_t>(job);
    const int spokes = spoke_counts[index / rims.size()];
    const ValveCandidate start = BestOfGrid(coarse, rims[index % rims.size()], spokes);
    ValveCandidate& valve = refined[index];
    valve = start;
    valve.log_likelihood = ScoreOf(start, fine);
    ValveCandidate tried = Refine(fine.Footprints(), start, {});
    tried.log_likelihood = ScoreOf(tried, fine);
    if (tried.log_likelihood > valve.log_likelihood) valve = tried;
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "fitting the valve was cancelled");

  std::vector<ValveCandidate> best;
  for (std::size_t n = 0; n < spoke_counts.size(); ++n) {
    const auto first = refined.begin() + static_cast<std::ptrdiff_t>(n * rims.size());
    best.push_back(*std::max_element(
        first, first + static_cast<std::ptrdiff_t>(rims.size()),
        [](const auto& a, const auto& b) { return a.log_likelihood < b.log_likelihood; }));
  }
  std::stable_sort(best.begin(), best.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  return best;
}

}  // namespace foresight
