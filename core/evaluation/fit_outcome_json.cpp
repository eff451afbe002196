#include "core/evaluation/fit_outcome_json.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/io/json_numbers.h"

namespace foresight {
namespace {

using nlohmann::ordered_json;

double NumberFrom(const ordered_json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

VerdictLevel LevelFrom(const std::string& name) {
  const Result<VerdictLevel> level = VerdictLevelFromString(name);
  if (!level) throw std::invalid_argument(level.error().message);
  return *level;
}

FitWorld WorldFrom(const ordered_json& value) {
  if (!value.contains("world")) return FitWorld::kHome;  // tables of earlier programs
  const Result<FitWorld> world = FitWorldFromString(value.at("world").get<std::string>());
  if (!world) throw std::invalid_argument(world.error().message);
  return *world;
}

ordered_json NamedNumbers(const std::vector<std::pair<std::string, double>>& numbers) {
  ordered_json object = ordered_json::object();
  for (const auto& [name, value] : numbers) object[name] = FiniteOrNull(value);
  return object;
}

std::vector<std::pair<std::string, double>> NamedNumbersFrom(const ordered_json& object) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const auto& [name, value] : object.items()) numbers.emplace_back(name, NumberFrom(value));
  return numbers;
}

FitOutcome OutcomeFrom(const ordered_json& value) {
  FitOutcome outcome;
  outcome.world = WorldFrom(value);
  if (!value.at("seed").is_number_unsigned()) throw std::invalid_argument("'seed' is no seed");
  outcome.seed = value.at("seed");
  outcome.what = value.at("what");
  outcome.source = value.at("source");
  outcome.positive = value.at("positive");
  outcome.found = value.at("found");
  outcome.pose_ok = value.at("pose_ok");
  outcome.all_ok = value.at("all_ok");
  outcome.verdict.level = LevelFrom(value.at("verdict"));
  outcome.verdict.probability = NumberFrom(value.at("probability"));
  for (const auto& feature : value.at("features"))
    outcome.verdict.features.push_back(NumberFrom(feature));
  // Tables of earlier programs have neither.
  if (value.contains("gates")) outcome.verdict.failed_gates = value["gates"];
  if (value.contains("evidence")) outcome.evidence = NamedNumbersFrom(value["evidence"]);
  outcome.errors = NamedNumbersFrom(value.at("errors"));
  outcome.seconds = NumberFrom(value.at("seconds"));
  outcome.reason = value.at("reason");
  return outcome;
}

}  // namespace

std::string FitOutcomeToJson(const FitOutcome& outcome) {
  ordered_json features = ordered_json::array();
  for (const double feature : outcome.verdict.features) features.push_back(FiniteOrNull(feature));
  const ordered_json json = {{"world", ToString(outcome.world)},
                             {"seed", outcome.seed},
                             {"what", outcome.what},
                             {"source", outcome.source},
                             {"positive", outcome.positive},
                             {"found", outcome.found},
                             {"pose_ok", outcome.pose_ok},
                             {"all_ok", outcome.all_ok},
                             {"verdict", ToString(outcome.verdict.level)},
                             {"probability", FiniteOrNull(outcome.verdict.probability)},
                             {"features", features},
                             {"gates", outcome.verdict.failed_gates},
                             {"evidence", NamedNumbers(outcome.evidence)},
                             {"errors", NamedNumbers(outcome.errors)},
                             {"seconds", FiniteOrNull(outcome.seconds)},
                             {"reason", outcome.reason}};
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Result<FitOutcome> FitOutcomeFromJson(std::string_view line) {
  try {
    return OutcomeFrom(ordered_json::parse(line));
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "outcome of a fit: {}", failure.what());
  }
}

Result<std::vector<FitOutcome>> LoadFitOutcomes(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string text, ReadFile(path));
  std::vector<FitOutcome> outcomes;
  int number = 1;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1, ++number) {
    auto outcome = FitOutcomeFromJson(std::string_view(text).substr(begin, end - begin));
    if (!outcome)
      return Fail(ErrorCode::kBadData, "{}:{}: {}", path.string(), number, outcome.error().message);
    outcomes.push_back(std::move(*outcome));
  }
  return outcomes;
}

}  // namespace foresight
