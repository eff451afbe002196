// From a region to ranked candidates: what an operator waits for a fit, on as many threads as there
// are cores and on one.
//   fit_pace [COUNT] [FIRST_SEED] [KIND]
// For each object, or one kind alone, COUNT (20) scenes of its population at home from FIRST_SEED
// (1) on, fitted to the lidar's returns and to the dense map (which is there already when an
// operator draws a region).
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/base/quantile.h"
#include "core/evaluation/fit_populations.h"

namespace foresight {
namespace {

double Seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Times {
  std::vector<double> all_threads, one_thread;
};

void Fit(const FitPopulation& population, const FitTrial& trial, const ProcessedScan& scan,
         FitSource source, Times& times) {
  const FitOptions options = population.Options(trial.rig);
  RunContext one;
  one.threads = 1;
  for (auto& [context, into] : {std::pair<RunContext, std::vector<double>*>{{}, &times.all_threads},
                                {one, &times.one_thread}})
    into->push_back(Seconds([&] {
      if (const auto found = FitInScan(scan, source, trial.roi, options, context); !found)
        fmt::print(stderr, "seed {}: {}\n", trial.seed, found.error().message);
    }));
}

void Print(const std::string& kind, const char* source, const Times& times) {
  fmt::print("{:<8} {:<5} all threads: median {:.2f} s, 95 % {:.2f} s; one: {:.2f}, {:.2f} s\n",
             kind, source, Quantile(times.all_threads, 0.5), Quantile(times.all_threads, 0.95),
             Quantile(times.one_thread, 0.5), Quantile(times.one_thread, 0.95));
  std::fflush(stdout);
}

Status Measure(const std::string& kind, int count, std::uint64_t first_seed) {
  FORESIGHT_TRY(const auto population, MakeFitPopulation(kind));
  FitTrialOptions options;
  FORESIGHT_TRY(const NamedSource dense, FitSourceFromName("foresight"));
  options.sources.push_back(dense);
  Times raw, of_map;
  for (int i = 0; i < count; ++i) {
    FORESIGHT_TRY(const FitTrial trial, MakeFitTrial(*population, first_seed + i, options, {}));
    FORESIGHT_TRY(const DepthResult depth, ComputeDepthInFrame(trial.cloud, trial.rig, trial.frame,
                                                               DefaultsOf(dense.method), {}));
    Fit(*population, trial, {trial.rig, trial.cloud, {trial.frame}}, FitSource::kRaw, raw);
    Fit(*population, trial, {trial.rig, trial.cloud, {trial.frame}, &depth}, dense.source, of_map);
  }
  Print(kind, "lidar", raw);
  Print(kind, "dense", of_map);
  return {};
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 20;
  const auto first_seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const std::string only = argc > 3 ? argv[3] : "";
  for (const std::string& kind : foresight::FitPopulationKinds()) {
    if (!only.empty() && kind != only) continue;
    if (const auto measured = foresight::Measure(kind, count, first_seed); !measured) {
      fmt::print(stderr, "{}: {}\n", kind, measured.error().message);
      return 3;
    }
  }
  return 0;
}
