#include <memory>

#include "app/ctl/command.h"
#include "core/base/atomic_file.h"
#include "core/evaluation/fit_outcome_json.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/verdict_fit.h"

namespace foresight {
namespace {

struct VerdictArguments {
  std::string kind;
  std::vector<std::string> tables;
  std::string source = "raw";
  std::string population;
  std::string out;
};

VerdictSource SourceOf(const FitOutcome& outcome) {
  if (outcome.source == "raw") return VerdictSource::kRaw;
  return outcome.source.ends_with(kAloneSuffix) ? VerdictSource::kAlone : VerdictSource::kDense;
}

Result<ExitCode> FitVerdict(const VerdictArguments& arguments, const RunContext&) {
  FORESIGHT_TRY(const std::unique_ptr<FitPopulation> population, MakeFitPopulation(arguments.kind));
  const auto source = VerdictSourceFromString(arguments.source);
  if (!source)
    return Fail(ErrorCode::kInvalidOptions, "--source {} is not known", arguments.source);
  std::vector<FitOutcome> outcomes;
  for (const std::string& table : arguments.tables) {
    FORESIGHT_TRY(const std::vector<FitOutcome> loaded, LoadFitOutcomes(table));
    for (const FitOutcome& outcome : loaded)
      if (SourceOf(outcome) == *source) outcomes.push_back(outcome);
  }
  VerdictFitOptions options;
  options.object = arguments.kind;
  options.source = *source;
  options.population = arguments.population;
  options.features = population->FeatureNames();
  FORESIGHT_TRY(const VerdictFit fit, FitVerdictModel(outcomes, options));
  const VerdictModel& model = fit.model;
  FORESIGHT_CHECK(WriteFileAtomically(arguments.out, model.ToYaml()));
  PrintLine(fmt::format("{}: {} fits, {} right; AUC {:.3f}, ECE {:.3f} (cross-validated)",
                        arguments.out, model.fits, model.right, model.auc, model.ece));
  for (const SureAnswers& sure : fit.sure)
    PrintLine(
        fmt::format("  {}: of {} right answers {} are called as sure as CONFIRMED by weights that "
                    "have not seen them, and {} that are not, {} of these where there was nothing",
                    ToString(sure.world), sure.right_answers, sure.sure_right,
                    sure.sure - sure.sure_right, sure.sure_negatives));
  return ExitCode::kDone;
}

}  // namespace

void AddVerdictCommand(CLI::App& app, Invocation& invocation) {
  CLI::App* verdict = app.add_subcommand("verdict", "How far an answer may be trusted");
  verdict->require_subcommand(1);
  const auto arguments = std::make_shared<VerdictArguments>();
  CLI::App* fit = verdict->add_subcommand(
      "fit", "Fit the weights of a probability to judged answers (evaluate-fits --table)");
  fit->add_option("object", arguments->kind, "valve, drill, terrain or handle")
      ->required()
      ->check(CLI::IsMember(FitPopulationKinds()));
  fit->add_option("tables", arguments->tables, "Outcomes, one JSON object a line")->required();
  fit->add_option("--source", arguments->source,
                  "raw, dense (maps with the beams behind them) or alone (maps alone)")
      ->check(CLI::IsMember({"raw", "dense", "alone"}))
      ->capture_default_str();
  fit->add_option("--population", arguments->population,
                  "How the outcomes were made, for the file: scenes, seeds, sources")
      ->required();
  fit->add_option("-o,--out", arguments->out, "File for the weights (YAML)")->required();
  fit->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) { return FitVerdict(*arguments, context); };
  });
}

}  // namespace foresight
