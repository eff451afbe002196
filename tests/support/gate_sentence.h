#pragma once

#include <cmath>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace foresight::samples {

/// A number and its limit as a reason states them.
struct StatedGate {
  double number = 0.0;
  bool at_least = true;
  double limit = 0.0;
  bool unknown = false;      ///< "an unknown number"
  bool just_beside = false;  ///< "just under", "just over"

  /// The number is on the side of its limit on which a gate fails, and differs from it.
  bool Fails() const {
    if (unknown || just_beside) return true;
    return at_least ? number < limit : number > limit;
  }
};

/// What a reader takes "22 %", "12 : 1", "1 : 400", "10^13 : 1" for; of odds the power of ten.
inline std::optional<double> StatedNumber(const std::string& text) {
  static const std::regex kOdds(R"((10\^)?([\d.]+) : (10\^)?([\d.]+))"), kPlain(R"(-?[\d.]+)");
  std::smatch match;
  if (std::regex_search(text, match, kOdds)) {
    const auto power = [&](std::size_t i) {
      const double value = std::stod(match[i + 1]);
      return match[i].matched ? value : std::log10(value);
    };
    return power(1) - power(3);
  }
  if (std::regex_search(text, match, kPlain)) return std::stod(match[0]);
  return std::nullopt;
}

/// The gates that a reason states, in its order: each is what stands in brackets and the last
/// number before them.
inline std::vector<StatedGate> StatedGates(const std::string& reason) {
  static const std::regex kLimit(R"(\((usually )?at (least|most) ([^)]*)\))");
  static const std::regex kNumber(
      R"(an unknown number|(just (under|over) )?((10\^)?[\d.]+ : (10\^)?[\d.]+|-?\d+(\.\d+)?))");
  std::vector<StatedGate> gates;
  auto from = reason.begin();
  for (std::sregex_iterator limit(reason.begin(), reason.end(), kLimit), end; limit != end;
       ++limit) {
    const auto until = reason.begin() + limit->position();
    std::string last;
    for (std::sregex_iterator number(from, until, kNumber); number != end; ++number)
      last = number->str();
    from = until + limit->length();
    StatedGate gate;
    gate.unknown = last.find("unknown") != std::string::npos;
    gate.just_beside = last.find("just") != std::string::npos;
    gate.number = StatedNumber(last).value_or(std::nan(""));
    gate.at_least = (*limit)[2] == "least";
    gate.limit = StatedNumber((*limit)[3]).value_or(std::nan(""));
    gates.push_back(gate);
  }
  return gates;
}

}  // namespace foresight::samples
