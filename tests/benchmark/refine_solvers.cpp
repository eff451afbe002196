// The refinement of a valve, Ceres's, beside our own Levenberg-Marquardt from the same starts: same
// residuals, slopes, robust weights, roles and rounds (docs/adr/0026-solvers-of-the-fits.md).
//   refine_solvers [COUNT] [FIRST_SEED]
// COUNT (60) wheels of tests/support/valve_rays.h from FIRST_SEED (1) on; starts 10 mm, 3 deg and
// 10 % of the sizes off.
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "core/base/quantile.h"
#include "core/base/random.h"
#include "core/fitting/valve/refine_problem.h"
#include "core/fitting/valve/valve_coverage.h"
#include "core/fitting/wall.h"
#include "tests/support/valve_rays.h"

namespace foresight {
namespace {

/// Levenberg-Marquardt by hand, as it was before Ceres.
ValveCandidate RefineByOwn(const BeamFootprints& footprints, const ValveCandidate& start,
                           const RefineOptions& options) {
  RefineProblem problem(footprints, options);
  ValveCandidate best = start;
  ValveInformation information;
  ValveStep gradient;
  for (int round = 0; round < options.rounds; ++round) {
    problem.AssignRoles(best);
    Eigen::VectorXd residuals = problem.Residuals(best);
    double cost = problem.Cost(residuals);
    double damping = 1e-3;
    for (int step = 0; step < options.steps; ++step) {
      problem.Linearise(best, residuals, information, gradient);
      // A direction that no ray sees (the phase of a bare rim) must not make the system singular.
      ValveInformation damped = information;
      damped.diagonal() += damping * information.diagonal() + ValveStep::Constant(1e-3);
      const ValveCandidate tried = Retract(best, damped.ldlt().solve(-gradient));
      const Eigen::VectorXd tried_residuals = problem.Residuals(tried);
      const double tried_cost = problem.Cost(tried_residuals);
      if (!(tried_cost < cost)) {
        damping *= 10.0;
        continue;
      }
      damping = std::max(1e-7, damping * 0.1);
      const bool settled = cost - tried_cost < 1e-4 * cost;
      best = tried;
      residuals = tried_residuals;
      cost = tried_cost;
      if (settled) break;
    }
  }
  return best;
}

struct Outcome {
  std::vector<double> cost, center_mm, axis_deg, seconds;
};

void Add(const BeamFootprints& footprints, const ValveCandidate& valve, const ValveCandidate& truth,
         double seconds, Outcome& outcome) {
  RefineProblem problem(footprints, {});
  problem.AssignRoles(valve);
  outcome.cost.push_back(problem.Cost(problem.Residuals(valve)));
  const auto& at = valve.base_from_object;
  const auto& true_at = truth.base_from_object;
  outcome.center_mm.push_back(1e3 * (at.translation() - true_at.translation()).norm());
  const Eigen::Vector3d axis = at.Rotate(Eigen::Vector3d::UnitZ());
  outcome.axis_deg.push_back(
      std::acos(std::min(1.0, axis.dot(true_at.Rotate(Eigen::Vector3d::UnitZ())))) * 180.0 /
      std::numbers::pi);
  outcome.seconds.push_back(seconds);
}

template <class Refiner>
std::pair<ValveCandidate, double> Timed(const Refiner& refine) {
  const auto begin = std::chrono::steady_clock::now();
  const ValveCandidate valve = refine();
  return {valve, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

void Print(const char* name, const Outcome& outcome) {
  fmt::print("{:<20} cost {:.1f}, centre {:.2f} mm (90 % {:.2f}), axis {:.2f} deg, {:.2f} ms\n",
             name, Quantile(outcome.cost, 0.5), Quantile(outcome.center_mm, 0.5),
             Quantile(outcome.center_mm, 0.9), Quantile(outcome.axis_deg, 0.5),
             1e3 * Quantile(outcome.seconds, 0.5));
}

void Compare(int count, std::uint64_t first_seed) {
  Outcome own, ceres, longer;
  int ceres_lower = 0, own_lower = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    const auto scene = MakeValveScene(samples::RandomValveView(seed));
    Random random(seed, 1);
    const BeamFootprints footprints =
        ValveFootprints(scene.rays, SplitWall(scene.rays, random).wall);
    ValveStep off = ValveStep::Zero();
    for (const int p : {kMoveX, kMoveY, kMoveZ}) off[p] = 0.010 * random.Normal();
    for (const int p : {kTiltX, kTiltY, kPhase}) off[p] = 0.052 * random.Normal();
    off[kRimRadius] = 0.1 * scene.truth.model.rim_radius_m * random.Normal();
    const ValveCandidate start = Retract(scene.truth, off);
    RefineOptions more;
    more.rounds = 12;
    const auto [by_own, own_s] = Timed([&] { return RefineByOwn(footprints, start, {}); });
    const auto [by_ceres, ceres_s] = Timed([&] { return Refine(footprints, start, {}); });
    const auto [by_more, more_s] = Timed([&] { return Refine(footprints, start, more); });
    Add(footprints, by_own, scene.truth, own_s, own);
    Add(footprints, by_ceres, scene.truth, ceres_s, ceres);
    Add(footprints, by_more, scene.truth, more_s, longer);
    ceres_lower += ceres.cost.back() < 0.99 * own.cost.back() ? 1 : 0;
    own_lower += own.cost.back() < 0.99 * ceres.cost.back() ? 1 : 0;
  }
  Print("ours", own);
  Print("Ceres", ceres);
  Print("Ceres, 12 rounds", longer);
  fmt::print("cost lower by 1 % or more: ours {}, Ceres {} of {}\n", own_lower, ceres_lower, count);
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 60;
  const auto first_seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  foresight::Compare(count, first_seed);
  return 0;
}
