#include "core/evaluation/verdict_trial.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "core/fitting/compressed_nats.h"

namespace foresight {
namespace {

constexpr std::string_view kCompressed = "compressed:";

/// NaN where the answer has no number of this name.
double NumberOf(const FitOutcome& outcome, const std::vector<std::string>& features,
                std::string_view name) {
  if (name.starts_with(kCompressed))
    return Compressed(NumberOf(outcome, features, name.substr(kCompressed.size())));
  const auto feature = std::find(features.begin(), features.end(), name);
  const auto index = static_cast<std::size_t>(feature - features.begin());
  if (index < std::min(features.size(), outcome.verdict.features.size()))
    return outcome.verdict.features[index];
  for (const auto& [evidence, value] : outcome.evidence)
    if (evidence == name) return value;
  return std::numeric_limits<double>::quiet_NaN();
}

Status CheckName(std::string_view name, const std::vector<std::string>& features,
                 const std::vector<FitOutcome>& outcomes) {
  if (name.starts_with(kCompressed)) name.remove_prefix(kCompressed.size());
  std::set<std::string> names(features.begin(), features.end());
  for (const FitOutcome& outcome : outcomes)
    for (const auto& [evidence, value] : outcome.evidence) names.insert(evidence);
  if (names.contains(std::string(name))) return {};
  return Fail(ErrorCode::kInvalidOptions, "'{}' is no number of these answers: they have {}", name,
              fmt::join(names, ", "));
}

}  // namespace

Result<TrialGate> TrialGateFrom(std::string_view text) {
  for (const std::string_view side : {">=", "<="}) {
    const std::size_t at = text.find(side);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view number = text.substr(at + side.size());
    TrialGate gate{std::string(text.substr(0, at)), side == ">="};
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), gate.limit);
    if (error == std::errc() && end == number.data() + number.size() && std::isfinite(gate.limit))
      return gate;
  }
  return Fail(ErrorCode::kInvalidOptions, "gate '{}' is no NAME>=NUMBER or NAME<=NUMBER", text);
}

Status AddTrialGate(const TrialGate& gate, const std::vector<std::string>& features,
                    std::vector<FitOutcome>& outcomes) {
  FORESIGHT_CHECK(CheckName(gate.name, features, outcomes));
  for (FitOutcome& outcome : outcomes) {
    if (!outcome.found) continue;
    const double number = NumberOf(outcome, features, gate.name);
    if (gate.at_least ? number >= gate.limit : number <= gate.limit) continue;
    outcome.verdict.failed_gates.push_back(fmt::format(
        "{} is {} (at {} {})", gate.name, number, gate.at_least ? "least" : "most", gate.limit));
  }
  return {};
}

Status ReplaceFeatures(const std::vector<std::string>& wanted,
                       const std::vector<std::string>& features,
                       std::vector<FitOutcome>& outcomes) {
  for (const std::string& name : wanted) FORESIGHT_CHECK(CheckName(name, features, outcomes));
  for (FitOutcome& outcome : outcomes) {
    std::vector<double> values;
    for (const std::string& name : wanted) values.push_back(NumberOf(outcome, features, name));
    outcome.verdict.features = std::move(values);
  }
  return {};
}

Result<std::vector<OddsBin>> OddsOf(const std::string& name, double from, double to, int bins,
                                    const std::vector<std::string>& features,
                                    const std::vector<FitOutcome>& outcomes) {
  FORESIGHT_CHECK(CheckName(name, features, outcomes));
  if (!(to > from) || bins < 1)
    return Fail(ErrorCode::kInvalidOptions, "{} bins from {} to {} are none", bins, from, to);
  std::vector<OddsBin> odds(static_cast<std::size_t>(bins));
  const double width = (to - from) / bins;
  for (std::size_t i = 0; i < odds.size(); ++i) {
    odds[i].from = from + static_cast<double>(i) * width;
    odds[i].to = odds[i].from + width;
  }
  int all_right = bins, all_wrong = bins;
  for (const FitOutcome& outcome : outcomes) {
    if (outcome.world == FitWorld::kOther)
      return Fail(ErrorCode::kInvalidOptions,
                  "these are answers of the other world, which judges only");
    if (!outcome.found || !outcome.verdict.failed_gates.empty()) continue;
    if (outcome.pose_ok != outcome.all_ok) continue;  // the object, but not quite right
    const double number = NumberOf(outcome, features, name);
    if (!std::isfinite(number)) continue;
    const auto bin = static_cast<std::size_t>(
        std::clamp(std::floor((number - from) / width), 0.0, static_cast<double>(bins - 1)));
    ++(outcome.all_ok ? odds[bin].right : odds[bin].wrong);
    ++(outcome.all_ok ? all_right : all_wrong);
  }
  for (OddsBin& bin : odds)
    bin.nats = std::log((bin.right + 1.0) / all_right) - std::log((bin.wrong + 1.0) / all_wrong);
  return odds;
}

}  // namespace foresight
