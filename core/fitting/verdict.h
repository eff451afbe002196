#pragma once

#include <string>
#include <vector>

namespace foresight {

enum class VerdictLevel { kUnsure, kLikely, kConfirmed };
/// "UNSURE", "LIKELY", "CONFIRMED".
const char* ToString(VerdictLevel level);

/// What an operator may make of a fit.
struct Verdict {
  VerdictLevel level = VerdictLevel::kUnsure;
  double probability = 0.0;  ///< that the pose is right, in [0, 1]
  std::string reason;        ///< one sentence
  /// What the probability was computed from, in the order of the object's VerdictModel.
  std::vector<double> features;

  static constexpr double kLikely = 0.70;     ///< least probability of LIKELY
  static constexpr double kConfirmed = 0.95;  ///< ... and of CONFIRMED
};

/// The level that a probability earns; CONFIRMED only where no hard gate objects.
VerdictLevel LevelFor(double probability, bool objected);

}  // namespace foresight
