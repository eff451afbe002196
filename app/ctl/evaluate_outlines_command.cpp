#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "core/base/parallel.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/outline_trial.h"

namespace foresight {
namespace {

struct EvaluateOutlinesArguments {
  std::vector<std::string> worlds = {"home", "varied"};
  std::uint64_t first_seed = 1;
  int count = 200;
  bool json = false;
};

/// Of a bin, what the right outline is likelier by.
double NatsOf(const OutlineTrial& trial, std::size_t bin) {
  constexpr double kLeast = 1e-3;
  return std::log((trial.right.Fraction(bin) + kLeast) / (trial.wrong.Fraction(bin) + kLeast));
}

void Print(const OutlineTrial& trial) {
  fmt::print("{} scenes, {:.0f} px of right outlines, {:.0f} px of wrong ones\n", trial.scenes,
             trial.right.LengthPx(), trial.wrong.LengthPx());
  fmt::print("response from   right   wrong   nats   in the program\n");
  for (std::size_t i = 0; i < OutlineResponses::kBins; ++i) {
    const double from = OutlineResponses::kFrom[i];
    const double to = i + 1 < OutlineResponses::kBins ? OutlineResponses::kFrom[i + 1] : 1.5 * from;
    fmt::print("{:13.1f} {:5.1f} % {:5.1f} % {:6.2f} {:16.2f}\n", from,
               100.0 * trial.right.Fraction(i), 100.0 * trial.wrong.Fraction(i), NatsOf(trial, i),
               ImageEdges::NatsOf(0.5 * (from + to)));
  }
}

void PrintAsJson(const OutlineTrial& trial) {
  nlohmann::ordered_json bins = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < OutlineResponses::kBins; ++i)
    bins.push_back({{"response_from", OutlineResponses::kFrom[i]},
                    {"right", trial.right.Fraction(i)},
                    {"wrong", trial.wrong.Fraction(i)},
                    {"nats", NatsOf(trial, i)}});
  PrintJson({{"scenes", trial.scenes},
             {"right_px", trial.right.LengthPx()},
             {"wrong_px", trial.wrong.LengthPx()},
             {"bins", bins}});
}

/// Adds all scenes of one world.
Status RunTrials(const FitPopulation& population, const EvaluateOutlinesArguments& arguments,
                 const RunContext& context, OutlineTrial& trial) {
  RunContext one_thread = context;
  one_thread.threads = 1;
  one_thread.progress = nullptr;
  std::mutex mutex;
  Status failed;
  int done = 0;
  const auto run = [&](int i) {
    OutlineTrial of_scene;
    const Status status = AddOutlinesOf(
        population, arguments.first_seed + static_cast<std::uint64_t>(i), one_thread, of_scene);
    const std::scoped_lock lock(mutex);
    if (!status) failed = status;
    trial.scenes += of_scene.scenes;
    trial.right.Add(of_scene.right);
    trial.wrong.Add(of_scene.wrong);
    context.Report(static_cast<double>(++done) / arguments.count, "fitting");
  };
  if (!ParallelFor(arguments.count, context, run))
    return Fail(ErrorCode::kCancelled, "the evaluation of outlines was cancelled");
  return failed;
}

Result<ExitCode> EvaluateOutlines(const EvaluateOutlinesArguments& arguments,
                                  const RunContext& context) {
  OutlineTrial trial;
  const double worlds = static_cast<double>(arguments.worlds.size());
  for (std::size_t w = 0; w < arguments.worlds.size(); ++w) {
    FORESIGHT_TRY(const FitWorld world, FitWorldFromString(arguments.worlds[w]));
    FORESIGHT_TRY(const auto population, MakeFitPopulation("drill", world));
    const double index = static_cast<double>(w);
    FORESIGHT_CHECK(RunTrials(*population, arguments,
                              context.Part(index / worlds, (index + 1.0) / worlds), trial));
  }
  if (arguments.json)
    PrintAsJson(trial);
  else
    Print(trial);
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateOutlinesCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateOutlinesArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate-outlines",
      "What images show along the outlines of drills that are fitted right, and of the fits that "
      "point the other way: what an edge is worth");
  command->add_option("--world", arguments->worlds, "home, varied")
      ->delimiter(',')
      ->check(CLI::IsMember({"home", "varied"}))
      ->capture_default_str();
  AddSeedOption(*command, "--first-seed", arguments->first_seed, "Seed of the first scene")
      ->capture_default_str();
  command->add_option("--count", arguments->count, "Number of scenes of each world")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return EvaluateOutlines(*arguments, context);
    };
  });
}

}  // namespace foresight
