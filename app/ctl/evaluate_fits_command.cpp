#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <regex>
#include <set>

#include "app/common/seed_option.h"
#include "app/ctl/command.h"
#include "app/ctl/depth_files.h"
#include "core/base/atomic_file.h"
#include "core/base/parallel.h"
#include "core/evaluation/fit_outcome_json.h"
#include "core/evaluation/fit_populations.h"
#include "core/evaluation/fit_statistics.h"
#include "core/evaluation/like_home.h"
#include "core/evaluation/plain_cloud.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

struct EvaluateFitsArguments {
  std::string kind;
  std::string world = "home";
  std::vector<std::string> like_home;  ///< conditions of the other world
  std::uint64_t first_seed = 1;
  int count = 50;
  std::string only;  ///< "positives", "negatives"; empty = both
  std::vector<std::string> sources = {"raw", "foresight"};
  double rotation_error_deg = 0.0;
  double translation_error_mm = 0.0;
  double outline_weight = ImageEdges::kIndependentPerPixel;
  std::string table;  ///< empty = kept in memory only
  std::string what;   ///< pattern of the scenes that are counted; empty = all
  bool json = false;
};

Result<FitTrialOptions> TrialOptionsFrom(const EvaluateFitsArguments& arguments) {
  FitTrialOptions options;
  options.sources.clear();
  for (const std::string& name : arguments.sources) {
    if (name == kCloudSource) {
      options.plain_cloud = true;
      continue;
    }
    FORESIGHT_TRY(const NamedSource source, FitSourceFromName(name));
    options.sources.push_back(source);
  }
  if (arguments.rotation_error_deg > 0.0 || arguments.translation_error_mm > 0.0)
    options.rig_error = CalibrationError{RadiansFromDegrees(arguments.rotation_error_deg),
                                         arguments.translation_error_mm / 1000.0};
  options.outline_weight = arguments.outline_weight;
  FORESIGHT_CHECK(options.Check());
  return options;
}

/// The outcomes so far, on disk as they come: a run that is cut goes on where it was.
class OutcomeTable {
 public:
  Status Open(const std::string& path) {
    if (path.empty()) return {};
    path_ = path;
    FORESIGHT_TRY(const std::filesystem::path target, ResolveOutput(path));
    if (std::error_code error; std::filesystem::exists(target, error)) {
      FORESIGHT_TRY(outcomes_, LoadFitOutcomes(path));
      FORESIGHT_CHECK(DropTornLine(path));
    }
    return AppendToFile(path, "");  // not after hours of trials
  }

  /// A seed means another scene in each world. Fails with kInvalidInput.
  Status CheckWorld(FitWorld world) const {
    for (const FitOutcome& outcome : outcomes_)
      if (outcome.world != world)
        return Fail(ErrorCode::kInvalidInput,
                    "{}: seed {} in it is of the {} world: name another table", path_, outcome.seed,
                    ToString(outcome.world));
    return {};
  }

  std::set<std::uint64_t> Seeds() const {
    std::set<std::uint64_t> seeds;
    for (const FitOutcome& outcome : outcomes_) seeds.insert(outcome.seed);
    return seeds;
  }

  /// Fails with kIo where they could not be written, e.g. on a disk that is full.
  Status Add(const std::vector<FitOutcome>& outcomes) {
    const std::lock_guard lock(mutex_);
    outcomes_.insert(outcomes_.end(), outcomes.begin(), outcomes.end());
    if (path_.empty()) return {};
    std::string lines;
    for (const FitOutcome& outcome : outcomes) lines += FitOutcomeToJson(outcome) + "\n";
    return AppendToFile(path_, lines);
  }

  /// In the order of their seeds, whatever threads did.
  std::vector<FitOutcome> Sorted() const {
    std::vector<FitOutcome> sorted = outcomes_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.seed < b.seed; });
    return sorted;
  }

 private:
  Status DropTornLine(const std::string& path) const {
    FORESIGHT_TRY(const std::string text, ReadFile(path));
    const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    std::error_code error;
    if (whole < text.size()) std::filesystem::resize_file(path, whole, error);
    if (error) return Fail(ErrorCode::kIo, "{}: {}", path, error.message());
    return {};
  }

  std::mutex mutex_;
  std::string path_;  ///< empty = kept in memory only
  std::vector<FitOutcome> outcomes_;
};

/// As many seeds from the first on as were asked for, of scenes that hold the object, hold none, or
/// both as they come.
std::vector<std::uint64_t> SeedsOf(const FitPopulation& population,
                                   const EvaluateFitsArguments& arguments) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = arguments.first_seed; std::ssize(seeds) < arguments.count; ++seed)
    if (arguments.only.empty() ||
        population.MakeScene(seed).positive == (arguments.only == "positives"))
      seeds.push_back(seed);
  return seeds;
}

Status RunTrials(const FitPopulation& population, const EvaluateFitsArguments& arguments,
                 OutcomeTable& table, const RunContext& context) {
  FORESIGHT_TRY(const FitTrialOptions options, TrialOptionsFrom(arguments));
  const std::set<std::uint64_t> done = table.Seeds();
  std::vector<std::uint64_t> seeds = SeedsOf(population, arguments);
  std::erase_if(seeds, [&](std::uint64_t seed) { return done.contains(seed); });
  std::mutex mutex;
  Status failure;
  int finished = 0;
  const bool whole = ParallelFor(static_cast<int>(std::ssize(seeds)), context, [&](int i) {
    {
      const std::lock_guard lock(mutex);
      if (!failure && failure.error().code == ErrorCode::kIo) return;  // nothing could be kept
    }
    const std::uint64_t seed = seeds[static_cast<std::size_t>(i)];
    const auto outcomes = RunFitTrial(population, seed, options, context);
    const Status kept = outcomes ? table.Add(*outcomes) : Status();
    const std::lock_guard lock(mutex);
    if (!outcomes && failure)
      failure = Fail(outcomes.error().code, "seed {}: {}", seed, outcomes.error().message);
    if (!kept) failure = kept;
    ++finished;
    PrintProgress(fmt::format("{} of {} scenes", finished, seeds.size()),
                  finished == std::ssize(seeds) ? ProgressEnd::kLast : ProgressEnd::kMore);
  });
  if (!whole) return Fail(ErrorCode::kCancelled, "the trials were cancelled");
  return failure;
}

std::string FractionText(int part, int whole) {
  return whole > 0
             ? fmt::format("{:.3f} ({} of {})", static_cast<double>(part) / whole, part, whole)
             : "-";
}

void PrintTable(const FitStatistics& s) {
  PrintLine(fmt::format("{}", s.source));
  PrintLine(fmt::format("  pose right        {}", FractionText(s.pose_ok, s.positives)));
  if (std::isfinite(s.recall)) PrintLine(fmt::format("  recall            {:.3f}", s.recall));
  PrintLine(fmt::format("  all right         {}", FractionText(s.all_ok, s.positives)));
  PrintLine(fmt::format("  CONFIRMED right   {}", FractionText(s.confirmed_right, s.confirmed)));
  PrintLine(fmt::format("  LIKELY right      {}", FractionText(s.likely_right, s.likely)));
  PrintLine(fmt::format("  negatives         {} scenes, {} CONFIRMED, {} LIKELY", s.negatives,
                        s.negatives_confirmed, s.negatives_likely));
  if (std::isfinite(s.false_area))
    PrintLine(fmt::format("  false area        {:.2f} % of what is LIKELY or CONFIRMED",
                          100.0 * s.false_area));
  if (s.compared > 0)
    PrintLine(fmt::format("  same verdict as the first source in {} of {} scenes", s.same_verdict,
                          s.compared));
  if (const PairedLead& ahead = s.first_ahead; ahead.scenes > 0)
    PrintLine(fmt::format(
        "  right where only one of the two is: the first source {}, this {}; the first is "
        "ahead by {:.2f} a scene (95 %: {:.2f} to {:.2f}; {} scenes)",
        ahead.only_first, ahead.only_second, ahead.lead, ahead.low, ahead.high, ahead.scenes));
  if (std::isfinite(s.auc)) PrintLine(fmt::format("  AUC {:.3f}, ECE {:.3f}", s.auc, s.ece));
  for (const ErrorSpread& error : s.errors)
    PrintLine(
        fmt::format("  {:<16}  median {:.3f}, 95 % {:.3f}", error.name, error.median, error.p95));
  for (const SigmaSpread& sigma : s.sigmas)
    PrintLine(fmt::format("  {:<16}  spread over predicted {:.2f}, root mean square {:.2f}",
                          sigma.name, sigma.robust, sigma.rms));
  for (const ReasonCount& reason : s.right_not_confirmed)
    PrintLine(fmt::format("  right, not CONFIRMED {:>3}: {}", reason.count, reason.reason));
  PrintLine(fmt::format("  CPU               median {:.2f} s, 95 % {:.2f} s", s.seconds_median,
                        s.seconds_p95));
}

nlohmann::ordered_json ToJson(const PairedLead& ahead) {
  return {{"scenes", ahead.scenes},
          {"only_first", ahead.only_first},
          {"only_this", ahead.only_second},
          {"lead", ahead.lead},
          {"low", ahead.low},
          {"high", ahead.high}};
}

nlohmann::ordered_json ToJson(const FitStatistics& s) {
  nlohmann::ordered_json errors = nlohmann::ordered_json::object();
  for (const ErrorSpread& error : s.errors)
    errors[error.name] = {{"median", FiniteOrNull(error.median)}, {"p95", FiniteOrNull(error.p95)}};
  nlohmann::ordered_json sigmas = nlohmann::ordered_json::object();
  for (const SigmaSpread& sigma : s.sigmas)
    sigmas[sigma.name] = {{"spread_over_predicted", FiniteOrNull(sigma.robust)},
                          {"root_mean_square", FiniteOrNull(sigma.rms)}};
  nlohmann::ordered_json reasons = nlohmann::ordered_json::array();
  for (const ReasonCount& reason : s.right_not_confirmed)
    reasons.push_back({{"reason", reason.reason}, {"count", reason.count}});
  return {{"source", s.source},
          {"positives", s.positives},
          {"found", s.found},
          {"pose_ok", s.pose_ok},
          {"all_ok", s.all_ok},
          {"recall", FiniteOrNull(s.recall)},
          {"false_area", FiniteOrNull(s.false_area)},
          {"confirmed", s.confirmed},
          {"confirmed_right", s.confirmed_right},
          {"likely", s.likely},
          {"likely_right", s.likely_right},
          {"negatives", s.negatives},
          {"negatives_confirmed", s.negatives_confirmed},
          {"negatives_likely", s.negatives_likely},
          {"compared", s.compared},
          {"same_verdict", s.same_verdict},
          {"first_ahead", s.first_ahead.scenes > 0 ? ToJson(s.first_ahead) : nullptr},
          {"auc", FiniteOrNull(s.auc)},
          {"ece", FiniteOrNull(s.ece)},
          {"errors", errors},
          {"sigmas", sigmas},
          {"right_not_confirmed", reasons},
          {"seconds",
           {{"median", FiniteOrNull(s.seconds_median)}, {"p95", FiniteOrNull(s.seconds_p95)}}}};
}

/// Which scenes are counted; an empty pattern fits all.
Result<std::regex> PatternFrom(const std::string& text) {
  constexpr std::size_t kLongest = 200;  // the standard's regex calls itself for each bracket
  if (text.size() > kLongest)
    return Fail(ErrorCode::kInvalidOptions, "--what: {} characters are more than {}", text.size(),
                kLongest);
  try {
    return std::regex(text);
  } catch (const std::regex_error& error) {
    return Fail(ErrorCode::kInvalidOptions, "--what {}: {}", text, error.what());
  }
}

Result<std::unique_ptr<FitPopulation>> PopulationFrom(const EvaluateFitsArguments& arguments) {
  FORESIGHT_TRY(const FitWorld world, FitWorldFromString(arguments.world));
  if (!arguments.like_home.empty() && world != FitWorld::kOther)
    return Fail(ErrorCode::kInvalidOptions, "--like-home changes --world other; at home all is so");
  FORESIGHT_TRY(std::unique_ptr<FitPopulation> population,
                MakeFitPopulation(arguments.kind, world));
  if (arguments.like_home.empty()) return population;
  std::vector<OtherCondition> conditions;
  for (const std::string& name : arguments.like_home) {
    FORESIGHT_TRY(const OtherCondition condition, OtherConditionFromString(name));
    conditions.push_back(condition);
  }
  return MakeLikeHome(std::move(population), std::move(conditions));
}

Result<ExitCode> EvaluateFits(const EvaluateFitsArguments& arguments, const RunContext& context) {
  FORESIGHT_TRY(const std::unique_ptr<FitPopulation> population, PopulationFrom(arguments));
  FORESIGHT_TRY(const std::regex what, PatternFrom(arguments.what));
  OutcomeTable table;
  FORESIGHT_CHECK(table.Open(arguments.table));
  FORESIGHT_CHECK(table.CheckWorld(population->World()));
  FORESIGHT_CHECK(RunTrials(*population, arguments, table, context));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::vector<FitOutcome> counted = table.Sorted();
  std::erase_if(counted, [&](const FitOutcome& o) { return !std::regex_search(o.what, what); });
  for (const FitStatistics& statistics : StatisticsOf(counted)) {
    if (arguments.json)
      json.push_back(ToJson(statistics));
    else
      PrintTable(statistics);
  }
  if (arguments.json) PrintJson(json);
  return ExitCode::kDone;
}

}  // namespace

void AddEvaluateFitsCommand(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<EvaluateFitsArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate-fits", "Try a fit on simulated scenes drawn at random, and judge every answer");
  command->add_option("object", arguments->kind, "valve, drill, terrain or handle")
      ->required()
      ->check(CLI::IsMember(FitPopulationKinds()));
  command
      ->add_option("--world", arguments->world,
                   "home, whose constants the fits know; varied, the same things under drawn "
                   "conditions, to choose by; or other, which shares none of them: it judges "
                   "only, nothing is ever fitted to it")
      ->check(CLI::IsMember({"home", "varied", "other"}))
      ->capture_default_str();
  command
      ->add_option("--like-home", arguments->like_home,
                   "Conditions of the other world that are made what they are at home, to see what "
                   "each costs: " +
                       fmt::format("{}", fmt::join(OtherConditionNames(), ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(OtherConditionNames()));
  AddSeedOption(*command, "--first-seed", arguments->first_seed, "Seed of the first scene")
      ->capture_default_str();
  command->add_option("--count", arguments->count, "Number of scenes")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--only", arguments->only,
                   "positives or negatives: pass over the seeds of the other scenes")
      ->check(CLI::IsMember({"positives", "negatives"}));
  command
      ->add_option(
          "--source", arguments->sources,
          "What to fit to: raw, cloud (the same returns as a file of points alone has them), or "
          "depth methods (with the returns behind the map, or with -alone after the name, without "
          "them): " +
              MethodNames())
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--rotation-error-deg", arguments->rotation_error_deg,
                   "How far the lidar's believed pose is turned from the true one")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--translation-error-mm", arguments->translation_error_mm,
                   "How far the lidar's believed pose is shifted from the true one")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command
      ->add_option(
          "--outline-weight", arguments->outline_weight,
          "What a pixel of an outline counts where fits look at the image; 0 = they do not")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--table", arguments->table,
                      "File for the outcomes, one JSON object a line; seeds that are in it already "
                      "are not run again");
  command->add_option("--what", arguments->what,
                      "Count only scenes whose description fits this pattern: 'lever', "
                      "'^(wheel|disc)[^,]*$' (to 2 m, not small)");
  command->add_flag("--json", arguments->json, "Print a JSON list, one object a source");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext& context) {
      return EvaluateFits(*arguments, context);
    };
  });
}

}  // namespace foresight
