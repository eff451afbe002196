#include "core/evaluation/fit_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "core/base/quantile.h"
#include "core/evaluation/sigma_errors.h"

namespace foresight {
namespace {

bool IsInSigmas(const std::string& name) {
  return name.ends_with(kSigmaErrorSuffix);
}

std::vector<std::string> ErrorNames(const std::vector<const FitOutcome*>& answers) {
  std::vector<std::string> names;
  for (const FitOutcome* answer : answers)
    for (const auto& [name, value] : answer->errors)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

/// Of one error, the finite values.
std::vector<double> SizesOf(const std::vector<const FitOutcome*>& answers,
                            const std::string& name) {
  std::vector<double> values;
  for (const FitOutcome* answer : answers)
    for (const auto& [error, value] : answer->errors)
      if (error == name && std::isfinite(value)) values.push_back(std::abs(value));
  return values;
}

std::vector<SigmaSpread> SigmaSpreadsOf(const std::vector<const FitOutcome*>& answers) {
  constexpr double kMedianOfNormal = 0.67449;
  std::vector<SigmaSpread> spreads;
  for (const std::string& name : ErrorNames(answers)) {
    if (!IsInSigmas(name)) continue;
    const std::vector<double> values = SizesOf(answers, name);
    double squares = 0.0;
    for (const double value : values) squares += value * value;
    spreads.push_back({name.substr(0, name.size() - std::strlen(kSigmaErrorSuffix)),
                       Quantile(values, 0.5) / kMedianOfNormal,
                       std::sqrt(squares / static_cast<double>(values.size()))});
  }
  return spreads;
}

/// "only # measurements lie on it".
std::string WithoutNumbers(const std::string& reason) {
  std::string text;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0; i < reason.size(); ++i) {
    if (!is_digit(reason[i])) {
      text += reason[i];
      continue;
    }
    text += '#';
    while (i + 1 < reason.size() &&
           (is_digit(reason[i + 1]) || ((reason[i + 1] == '.' || reason[i + 1] == ',') &&
                                        i + 2 < reason.size() && is_digit(reason[i + 2]))))
      ++i;
  }
  return text;
}

void CountReason(const std::string& reason, std::vector<ReasonCount>& counts) {
  const std::string text = WithoutNumbers(reason);
  const auto known = std::find_if(counts.begin(), counts.end(),
                                  [&](const ReasonCount& count) { return count.reason == text; });
  if (known != counts.end())
    ++known->count;
  else
    counts.push_back({text, 1});
}

std::vector<ErrorSpread> SpreadsOf(const std::vector<const FitOutcome*>& answers) {
  std::vector<ErrorSpread> spreads;
  for (const std::string& name : ErrorNames(answers)) {
    if (IsInSigmas(name)) continue;
    const std::vector<double> values = SizesOf(answers, name);
    spreads.push_back({name, Quantile(values, 0.5), Quantile(values, 0.95)});
  }
  return spreads;
}

/// NaN where an outcome has no such error.
double ErrorOf(const FitOutcome& outcome, std::string_view wanted) {
  for (const auto& [name, value] : outcome.errors)
    if (name == wanted) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

double MeanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Counts one outcome in; `scenes` are the negatives that count already.
void Count(const FitOutcome& outcome, FitStatistics& statistics) {
  const bool confirmed = outcome.found && outcome.verdict.level == VerdictLevel::kConfirmed;
  const bool likely = outcome.found && outcome.verdict.level == VerdictLevel::kLikely;
  const bool right = outcome.positive && outcome.all_ok;
  statistics.confirmed += confirmed ? 1 : 0;
  statistics.confirmed_right += confirmed && right ? 1 : 0;
  statistics.likely += likely ? 1 : 0;
  statistics.likely_right += likely && right ? 1 : 0;
  if (!outcome.positive) {
    statistics.negatives_confirmed += confirmed ? 1 : 0;
    statistics.negatives_likely += likely ? 1 : 0;
    return;
  }
  ++statistics.positives;
  statistics.found += outcome.found ? 1 : 0;
  statistics.pose_ok += outcome.pose_ok ? 1 : 0;
  statistics.all_ok += outcome.all_ok ? 1 : 0;
}

FitStatistics StatisticsOfSource(const std::string& source, std::span<const FitOutcome> outcomes) {
  FitStatistics statistics;
  statistics.source = source;
  std::vector<const FitOutcome*> good;
  std::vector<double> seconds, probabilities, there, false_areas;
  std::vector<bool> right;
  std::set<std::uint64_t> negatives;
  for (const FitOutcome& outcome : outcomes) {
    if (outcome.source != source) continue;
    Count(outcome, statistics);
    if (!outcome.positive) negatives.insert(outcome.seed);
    seconds.push_back(outcome.seconds);
    if (outcome.pose_ok) good.push_back(&outcome);
    if (outcome.positive && outcome.all_ok && outcome.verdict.level != VerdictLevel::kConfirmed)
      CountReason(outcome.reason, statistics.right_not_confirmed);
    // What is found in a scene but is none of the things in view is no miss.
    if (outcome.positive && (!outcome.found || ErrorOf(outcome, "in_view") != 0.0))
      there.push_back(outcome.pose_ok ? 1.0 : 0.0);
    if (!outcome.found) continue;
    if (const double area = ErrorOf(outcome, "false_area");
        std::isfinite(area) && outcome.verdict.level != VerdictLevel::kUnsure)
      false_areas.push_back(area);
    probabilities.push_back(outcome.verdict.probability);
    right.push_back(outcome.positive && outcome.all_ok);
  }
  statistics.negatives = static_cast<int>(negatives.size());
  statistics.recall = MeanOf(there);
  statistics.false_area = MeanOf(false_areas);
  statistics.errors = SpreadsOf(good);
  statistics.sigmas = SigmaSpreadsOf(good);
  std::stable_sort(statistics.right_not_confirmed.begin(), statistics.right_not_confirmed.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  statistics.auc = AreaUnderRoc(probabilities, right);
  statistics.ece = CalibrationErrorOf(probabilities, right);
  statistics.seconds_median = Quantile(seconds, 0.5);
  statistics.seconds_p95 = Quantile(seconds, 0.95);
  return statistics;
}

/// Of each scene, by its seed: how many answers are not there, UNSURE, LIKELY and CONFIRMED.
std::map<std::uint64_t, std::array<int, 4>> LevelsOf(const std::string& source,
                                                     std::span<const FitOutcome> outcomes) {
  std::map<std::uint64_t, std::array<int, 4>> levels;
  for (const FitOutcome& outcome : outcomes)
    if (outcome.source == source)
      ++levels[outcome.seed]
              [outcome.found ? 1 + static_cast<std::size_t>(outcome.verdict.level) : 0];
  return levels;
}

void CompareVerdicts(const std::string& first, std::span<const FitOutcome> outcomes,
                     FitStatistics& statistics) {
  const auto levels_of_first = LevelsOf(first, outcomes);
  for (const auto& [seed, levels] : LevelsOf(statistics.source, outcomes)) {
    const auto there = levels_of_first.find(seed);
    if (there == levels_of_first.end()) continue;
    ++statistics.compared;
    if (there->second == levels) ++statistics.same_verdict;
  }
}

/// Of each scene with the object in it: how many answers are right where it counts.
RightOfScenes RightAnswersOf(const std::string& source, std::span<const FitOutcome> outcomes) {
  RightOfScenes right;
  for (const FitOutcome& outcome : outcomes)
    if (outcome.source == source && outcome.positive) right[outcome.seed] += outcome.pose_ok;
  return right;
}

}  // namespace

std::vector<FitStatistics> StatisticsOf(std::span<const FitOutcome> outcomes) {
  std::vector<std::string> sources;
  for (const FitOutcome& outcome : outcomes)
    if (std::find(sources.begin(), sources.end(), outcome.source) == sources.end())
      sources.push_back(outcome.source);
  std::vector<FitStatistics> statistics;
  for (const std::string& source : sources)
    statistics.push_back(StatisticsOfSource(source, outcomes));
  for (FitStatistics& of_source : statistics) {
    if (of_source.source == sources.front()) continue;
    CompareVerdicts(sources.front(), outcomes, of_source);
    of_source.first_ahead = LeadOverSharedScenes(RightAnswersOf(sources.front(), outcomes),
                                                 RightAnswersOf(of_source.source, outcomes));
  }
  return statistics;
}

double AreaUnderRoc(std::span<const double> probabilities, const std::vector<bool>& right) {
  double ahead = 0.0;
  double pairs = 0.0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (!right[i]) continue;
    for (std::size_t j = 0; j < right.size(); ++j) {
      if (right[j]) continue;
      pairs += 1.0;
      if (probabilities[i] > probabilities[j])
        ahead += 1.0;
      else if (probabilities[i] == probabilities[j])
        ahead += 0.5;
    }
  }
  return pairs > 0.0 ? ahead / pairs : std::numeric_limits<double>::quiet_NaN();
}

double CalibrationErrorOf(std::span<const double> probabilities, const std::vector<bool>& right,
                          std::span<const double> weights) {
  constexpr int kBins = 10;
  std::array<double, kBins> promised{}, came_true{};
  double total = 0.0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const auto bin = static_cast<std::size_t>(
        std::clamp(static_cast<int>(kBins * probabilities[i]), 0, kBins - 1));
    const double weight = weights.empty() ? 1.0 : weights[i];
    promised[bin] += weight * probabilities[i];
    came_true[bin] += right[i] ? weight : 0.0;
    total += weight;
  }
  double error = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) error += std::abs(promised[bin] - came_true[bin]);
  return right.empty() ? std::numeric_limits<double>::quiet_NaN() : error / total;
}

}  // namespace foresight
