#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/evaluation/fit_outcome_json.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/plain_cloud.h"
#include "core/evaluation/verdict_fit.h"
#include "core/evaluation/verdict_trial.h"

namespace foresight {
namespace {

struct VerdictArguments {
  std::string kind;
  std::vector<std::string> tables;
  std::string source = "raw";
  std::string population;
  std::string out;                    ///< empty = nothing is written
  std::vector<std::string> features;  ///< other ones than the program's; empty = those
  std::vector<std::string> gates;     ///< more than the program's: "rim_nats>=10"
  bool no_gates = false;              ///< the program's are not asked
  bool no_pairs = false;              ///< each number counts by itself
  std::string odds_of;
  double from = 0.0;
  double to = 1.0;
  int bins = 10;
  bool json = false;
};

VerdictSource SourceOf(const FitOutcome& outcome) {
  if (outcome.source == "raw") return VerdictSource::kRaw;
  if (outcome.source == kCloudSource) return VerdictSource::kCloud;
  return outcome.source.ends_with(kAloneSuffix) ? VerdictSource::kAlone : VerdictSource::kDense;
}

Result<VerdictSource> SourceFrom(const VerdictArguments& arguments) {
  if (const auto source = VerdictSourceFromString(arguments.source)) return *source;
  return Fail(ErrorCode::kInvalidOptions, "--source {} is not known", arguments.source);
}

/// The answers of one source, as if the program had the arguments' features and gates.
Result<std::vector<FitOutcome>> OutcomesFrom(const VerdictArguments& arguments,
                                             VerdictSource source,
                                             const std::vector<std::string>& features) {
  std::vector<FitOutcome> outcomes;
  for (const std::string& table : arguments.tables) {
    FORESIGHT_TRY(const std::vector<FitOutcome> loaded, LoadFitOutcomes(table));
    for (const FitOutcome& outcome : loaded)
      if (SourceOf(outcome) == source) outcomes.push_back(outcome);
  }
  if (arguments.no_gates)
    for (FitOutcome& outcome : outcomes) outcome.verdict.failed_gates.clear();
  for (const std::string& text : arguments.gates) {
    FORESIGHT_TRY(const TrialGate gate, TrialGateFrom(text));
    FORESIGHT_CHECK(AddTrialGate(gate, features, outcomes));
  }
  if (!arguments.features.empty())
    FORESIGHT_CHECK(ReplaceFeatures(arguments.features, features, outcomes));
  return outcomes;
}

std::string CountText(const SureAnswers::Count& count) {
  return fmt::format("{} right and {} wrong ({} of these where there was nothing)", count.right,
                     count.wrong, count.negatives);
}

nlohmann::ordered_json ToJson(const SureAnswers::Count& count) {
  return {{"right", count.right}, {"wrong", count.wrong}, {"negatives", count.negatives}};
}

std::string PairText(double ridge) {
  return std::isfinite(ridge) ? fmt::format("with pairs, ridge {:.0f}", ridge)
                              : std::string("without pairs");
}

void Print(const VerdictFit& fit) {
  const VerdictModel& model = fit.model;
  PrintLine(
      fmt::format("{} {}: {} fits, {} right; AUC {:.3f}, ECE {:.3f}, log loss {:.3f} "
                  "(cross-validated)",
                  model.object, ToString(model.source), model.fits, model.right, model.auc,
                  model.ece, fit.log_loss));
  std::string tried;
  for (std::size_t i = 0; i < fit.log_losses.size(); ++i)
    tried += fmt::format("{}{:.3f} {}", i > 0 ? ", " : "", fit.log_losses[i],
                         PairText(fit.pair_ridges[i]));
  PrintLine(fmt::format("  log loss {}; taken: {}", tried, PairText(fit.pair_ridge)));
  for (const SureAnswers& sure : fit.sure)
    PrintLine(fmt::format(
        "  {}: of {} right answers, called as sure as CONFIRMED by weights that have not seen "
        "their scene: {}; gates leave {}",
        ToString(sure.world), sure.right_answers, CountText(sure.sure), CountText(sure.confirmed)));
}

nlohmann::ordered_json ToJson(const VerdictFit& fit) {
  nlohmann::ordered_json worlds = nlohmann::ordered_json::array();
  for (const SureAnswers& sure : fit.sure)
    worlds.push_back({{"world", ToString(sure.world)},
                      {"right_answers", sure.right_answers},
                      {"sure", ToJson(sure.sure)},
                      {"confirmed", ToJson(sure.confirmed)}});
  return {{"object", fit.model.object},
          {"source", ToString(fit.model.source)},
          {"fits", fit.model.fits},
          {"right", fit.model.right},
          {"auc", FiniteOrNull(fit.model.auc)},
          {"ece", FiniteOrNull(fit.model.ece)},
          {"log_loss", fit.log_loss},
          {"pair_ridge", FiniteOrNull(fit.pair_ridge)},
          {"worlds", worlds}};
}

Result<ExitCode> FitVerdict(const VerdictArguments& arguments, const RunContext&) {
  FORESIGHT_TRY(const std::unique_ptr<FitPopulation> population, MakeFitPopulation(arguments.kind));
  FORESIGHT_TRY(const VerdictSource source, SourceFrom(arguments));
  if (!arguments.out.empty() && !arguments.features.empty())
    return Fail(ErrorCode::kInvalidOptions,
                "--features is a trial: the program computes its own features, and cannot use "
                "weights of others; leave --out away");
  if (!arguments.out.empty() && arguments.population.empty())
    return Fail(ErrorCode::kInvalidOptions,
                "--out needs --population: the file says what its weights are true for");
  const std::vector<std::string> features = population->FeatureNames();
  FORESIGHT_TRY(const std::vector<FitOutcome> outcomes, OutcomesFrom(arguments, source, features));
  VerdictFitOptions options;
  options.object = arguments.kind;
  options.source = source;
  options.population = arguments.population;
  options.features = arguments.features.empty() ? features : arguments.features;
  if (arguments.no_pairs) options.pair_ridges = {std::numeric_limits<double>::infinity()};
  FORESIGHT_TRY(const VerdictFit fit, FitVerdictModel(outcomes, options));
  if (!arguments.out.empty())
    FORESIGHT_CHECK(WriteFileAtomically(arguments.out, fit.model.ToYaml()));
  if (arguments.json)
    PrintJson(ToJson(fit));
  else
    Print(fit);
  return ExitCode::kDone;
}

Result<ExitCode> PrintOdds(VerdictArguments arguments, const RunContext&) {
  FORESIGHT_TRY(const std::unique_ptr<FitPopulation> population, MakeFitPopulation(arguments.kind));
  FORESIGHT_TRY(const VerdictSource source, SourceFrom(arguments));
  arguments.no_gates = true;
  const std::vector<std::string> features = population->FeatureNames();
  FORESIGHT_TRY(const std::vector<FitOutcome> outcomes, OutcomesFrom(arguments, source, features));
  FORESIGHT_TRY(
      const std::vector<OddsBin> odds,
      OddsOf(arguments.odds_of, arguments.from, arguments.to, arguments.bins, features, outcomes));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const OddsBin& bin : odds) {
    json.push_back({{"from", bin.from},
                    {"to", bin.to},
                    {"right", bin.right},
                    {"wrong", bin.wrong},
                    {"nats", bin.nats}});
    if (!arguments.json)
      PrintLine(fmt::format("{:9.4f} to {:9.4f}: {:5} right, {:5} of another thing, {:5.1f} nats",
                            bin.from, bin.to, bin.right, bin.wrong, bin.nats));
  }
  if (arguments.json) PrintJson(json);
  return ExitCode::kDone;
}

/// Which answers a command looks at.
void AddAnswers(CLI::App& command, const std::shared_ptr<VerdictArguments>& arguments) {
  command.add_option("object", arguments->kind, "valve, drill, terrain or handle")
      ->required()
      ->check(CLI::IsMember(FitPopulationKinds()));
  command.add_option("tables", arguments->tables, "Outcomes, one JSON object a line")->required();
  command
      .add_option(
          "--source", arguments->source,
          "raw (returns of scans), cloud (returns alone), dense (maps with the beams behind "
          "them) or alone (maps alone)")
      ->check(CLI::IsMember({"raw", "cloud", "dense", "alone"}))
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "Print a JSON object");
}

void AddOdds(CLI::App& verdict, Invocation& invocation) {
  const auto arguments = std::make_shared<VerdictArguments>();
  CLI::App* odds = verdict.add_subcommand(
      "odds", "What a number says for an answer: how often right answers have it, and others");
  AddAnswers(*odds, arguments);
  odds->add_option("--of", arguments->odds_of, "A feature or evidence: size_margin")->required();
  odds->add_option("--from", arguments->from, "Where the first bin begins")->capture_default_str();
  odds->add_option("--to", arguments->to, "Where the last one ends")->capture_default_str();
  odds->add_option("--bins", arguments->bins, "How many there are")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  odds->add_option("--gate", arguments->gates,
                   "Only answers that keep this: 'confirmed_edges>=2'; may be given again")
      ->allow_extra_args(false);
  odds->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return PrintOdds(*arguments, context); };
  });
}

}  // namespace

void AddVerdictCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* verdict = app.add_subcommand("verdict", "How far an answer may be trusted");
  verdict->require_subcommand(1);
  const auto arguments = std::make_shared<VerdictArguments>();
  CLI::App* fit = verdict->add_subcommand(
      "fit", "Fit the weights of a probability to judged answers (evaluate-fits --table)");
  AddAnswers(*fit, arguments);
  fit->add_option("--population", arguments->population,
                  "How the outcomes were made, for the file: scenes, seeds, sources");
  fit->add_option("-o,--out", arguments->out,
                  "File for the weights (YAML); without it they are tried and not kept");
  fit->add_option("--features", arguments->features,
                  "Try these instead of the program's own: its features, any number of the "
                  "answers' evidence, or compressed:NAME of one, by commas")
      ->delimiter(',');
  fit->add_option("--gate", arguments->gates,
                  "Count as if this was asked before CONFIRMED, too: 'rim_nats>=10', "
                  "'log_chance_off<=-3'; may be given again")
      ->allow_extra_args(false);
  fit->add_flag("--no-gates", arguments->no_gates,
                "Count as if the program asked nothing but --gate");
  fit->add_flag("--no-pairs", arguments->no_pairs,
                "Weights of each number by itself, not of pairs of them");
  fit->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return FitVerdict(*arguments, context); };
  });
  AddOdds(*verdict, invocation);
}

}  // namespace foresight
