#include "core/fitting/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/contract.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr int kMostExtraDecimals = 4;
constexpr double kWordedOdds = 6.0;  ///< powers of ten that are written out
constexpr double kLargeOdds = 3.0;   ///< powers of ten that read as certain

/// A value in the unit that is printed; of odds the power of ten.
double Printed(Gate::Unit unit, double value) {
  switch (unit) {
    case Gate::Unit::kFraction:
      return 100.0 * value;
    case Gate::Unit::kLength:
      return 1000.0 * value;
    case Gate::Unit::kAngle:
      return DegreesFromRadians(value);
    case Gate::Unit::kOdds:
      return value / std::numbers::ln10;
    case Gate::Unit::kCount:
    case Gate::Unit::kRatio:
      break;
  }
  return value;
}

const char* Suffix(Gate::Unit unit) {
  switch (unit) {
    case Gate::Unit::kFraction:
      return " %";
    case Gate::Unit::kLength:
      return " mm";
    case Gate::Unit::kAngle:
      return " deg";
    case Gate::Unit::kOdds:
    case Gate::Unit::kCount:
    case Gate::Unit::kRatio:
      break;
  }
  return "";
}

/// Decimals that a number of the limit's size is printed with.
int DecimalsFor(Gate::Unit unit, double printed_limit) {
  if (unit == Gate::Unit::kRatio) return 2;
  if (unit == Gate::Unit::kAngle && std::abs(printed_limit) < 10.0) return 1;
  return 0;
}

/// A number as a sentence has it, and what a reader takes it for.
struct Text {
  std::string text;
  double value = 0.0;
};

Text OddsText(double power, int extra) {
  const double size = std::abs(power);
  Text text;
  double shown = size;
  if (size < kWordedOdds) {
    const int digits = 2 + extra, whole = static_cast<int>(std::floor(size));
    const double step = std::pow(10.0, whole - digits + 1);
    const double odds = std::round(std::pow(10.0, size) / step) * step;
    text.text = fmt::format("{:.{}f}", odds, std::max(0, digits - 1 - whole));
    shown = std::log10(odds);
    // "1.0 : 1" is "1 : 1".
    if (text.text == "1.0") text.text = "1";
  } else {
    const double scale = std::pow(10.0, extra);
    shown = std::round(size * scale) / scale;
    text.text = fmt::format("10^{:.{}f}", shown, extra);
  }
  text.text = power < 0.0 && shown > 0.0 ? "1 : " + text.text : text.text + " : 1";
  text.value = power < 0.0 ? -shown : shown;
  return text;
}

Text NumberText(Gate::Unit unit, double printed, int decimals, int extra) {
  if (std::isnan(printed)) return {"an unknown number", printed};
  if (unit == Gate::Unit::kOdds) return OddsText(printed, extra);
  const double scale = std::pow(10.0, decimals + extra);
  Text text;
  text.value = std::round(printed * scale) / scale;
  text.text = fmt::format("{:.{}f}{}", text.value, decimals + extra, Suffix(unit));
  return text;
}

/// The fewest decimals that show on which side of the limit the number is.
std::pair<std::string, std::string> NumberAndLimit(const Gate& gate) {
  const double number = Printed(gate.unit, gate.number), limit = Printed(gate.unit, gate.limit);
  const int decimals = DecimalsFor(gate.unit, limit);
  std::pair<std::string, std::string> texts;
  for (int extra = 0; extra <= kMostExtraDecimals; ++extra) {
    const Text shown = NumberText(gate.unit, number, decimals, extra);
    Text at = NumberText(gate.unit, limit, decimals, 0);
    if (std::abs(at.value - limit) > 1e-9) at = NumberText(gate.unit, limit, decimals, extra);
    texts = {shown.text, at.text};
    const bool fails =
        gate.side == Gate::Side::kAtLeast ? shown.value < at.value : shown.value > at.value;
    if (fails || std::isnan(number)) return texts;
  }
  texts.first = (gate.side == Gate::Side::kAtLeast ? "just under " : "just over ") + texts.second;
  return texts;
}

/// What stands behind a limit. Beams are modelled as independent, which they hardly are: limits on
/// odds are so high for that, and odds just below them would read as certain.
std::string LimitNote(const Gate& gate) {
  if (!gate.limit_note.empty()) return " " + gate.limit_note;
  const bool read_as_certain = gate.unit == Gate::Unit::kOdds && gate.kind == Gate::Kind::kHard &&
                               gate.side == Gate::Side::kAtLeast && gate.number > 0.0 &&
                               Printed(gate.unit, gate.limit) >= kLargeOdds;
  return read_as_certain ? "; computed odds run high" : "";
}

/// The sentence of the first that failed.
std::string FirstFailed(const std::vector<Gate>& gates) {
  for (const Gate& gate : gates)
    if (gate.Failed()) return gate.Sentence();
  return "no single number is unusual";
}

}  // namespace

bool Gate::Failed() const {
  return side == Side::kAtLeast ? !(number >= limit) : !(number <= limit);
}

std::string Gate::Sentence() const {
  FORESIGHT_EXPECTS(Failed(), "a gate that holds gives no reason");
  const auto [number_text, limit_text] = NumberAndLimit(*this);
  std::string sentence = what;
  if (const std::size_t at = sentence.find("{}"); at != std::string::npos)
    sentence.replace(at, 2, number_text);
  sentence +=
      fmt::format(" ({}{} {}{})", kind == Kind::kUsual ? "usually " : "",
                  side == Side::kAtLeast ? "at least" : "at most", limit_text, LimitNote(*this));
  return advice.empty() ? sentence : sentence + ": " + advice;
}

void AddIfFailed(const Gate& gate, std::vector<std::string>& failed_gates) {
  if (gate.Failed()) failed_gates.push_back(gate.Sentence());
}

double MeanOf(const VerdictModel& model, std::string_view feature) {
  const auto found =
      std::find_if(model.features.begin(), model.features.end(),
                   [&](const VerdictModel::Feature& known) { return known.name == feature; });
  FORESIGHT_EXPECTS(found != model.features.end(), "a model has the features of its object");
  return found->mean;
}

std::vector<Gate> WeightiestFirst(const VerdictModel& model, std::span<const double> values,
                                  const std::vector<FeatureGate>& gates) {
  const std::vector<double> shares = model.Contributions(values);
  std::vector<std::pair<double, Gate>> weighty;
  for (const FeatureGate& it : gates)
    for (std::size_t i = 0; i < shares.size(); ++i)
      if (model.features[i].name == it.feature && shares[i] < 0.0 && it.gate.Failed())
        weighty.emplace_back(shares[i], it.gate);
  std::stable_sort(weighty.begin(), weighty.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Gate> usual;
  for (auto& [share, gate] : weighty) {
    gate.kind = Gate::Kind::kUsual;
    usual.push_back(std::move(gate));
  }
  return usual;
}

std::string ReasonOf(const Verdict& verdict, double least_likely, const std::string& confirmed,
                     const std::vector<Gate>& usual) {
  if (!verdict.failed_gates.empty()) return verdict.failed_gates.front();
  if (verdict.level == VerdictLevel::kConfirmed) return confirmed;
  const bool likely = verdict.level == VerdictLevel::kLikely;
  const Gate probability{.what = "its probability is {}",
                         .unit = Gate::Unit::kFraction,
                         // As ProbabilityText has it beside the reason: rounded down.
                         .number = std::floor(100.0 * verdict.probability + 1e-9) / 100.0,
                         .side = Gate::Side::kAtLeast,
                         .limit = likely ? Verdict::kConfirmed : least_likely,
                         .advice = FirstFailed(usual),
                         .limit_note = likely ? "for CONFIRMED" : "for LIKELY"};
  return probability.Sentence();
}

}  // namespace foresight
