#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace foresight {

enum class VerdictLevel { kUnsure, kLikely, kConfirmed };
/// "UNSURE", "LIKELY", "CONFIRMED".
const char* ToString(VerdictLevel level);
/// Fails with kBadData for any other word.
Result<VerdictLevel> VerdictLevelFromString(const std::string& name);

/// What an operator may make of a fit.
struct Verdict {
  VerdictLevel level = VerdictLevel::kUnsure;
  /// That the pose is right, in [0, 1]; NaN where none was calibrated for the object.
  double probability = 0.0;
  std::string reason;  ///< one sentence
  /// What the probability was computed from, in the order of the object's VerdictModel.
  std::vector<double> features;
  /// The hard gates that keep it from being CONFIRMED, whatever its probability, a sentence each,
  /// the weightiest first; empty when none does.
  std::vector<std::string> failed_gates = {};

  static constexpr double kLikely = 0.70;     ///< least probability of LIKELY
  static constexpr double kConfirmed = 0.95;  ///< ... and of CONFIRMED
};

/// "97 %", rounded down: nothing is ever certain. "over 99 %" from there on, "under 1 %" below; "no
/// probability" for NaN.
std::string ProbabilityText(double probability);

/// By how much another answer is behind, in words: "about as likely" below kComparable_nats (1 :
/// 20), "a little less likely" below 10, "clearly less likely" below 50, "far less likely"; "more
/// likely" where it is ahead, and "not comparable" for NaN.
const char* MarginWords(double nats);
inline constexpr double kComparable_nats = 3.0;

/// The level that a probability earns; CONFIRMED only where no hard gate objects.
VerdictLevel LevelFor(double probability, bool objected);

}  // namespace foresight
