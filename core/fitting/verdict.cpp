#include "core/fitting/verdict.h"

#include <cmath>

namespace foresight {

const char* ToString(VerdictLevel level) {
  switch (level) {
    case VerdictLevel::kUnsure:
      return "UNSURE";
    case VerdictLevel::kLikely:
      return "LIKELY";
    case VerdictLevel::kConfirmed:
      return "CONFIRMED";
  }
  return "UNSURE";
}

Result<VerdictLevel> VerdictLevelFromString(const std::string& name) {
  for (const VerdictLevel level :
       {VerdictLevel::kUnsure, VerdictLevel::kLikely, VerdictLevel::kConfirmed})
    if (name == ToString(level)) return level;
  return Fail(ErrorCode::kBadData, "verdict '{}' is not known", name);
}

std::string ProbabilityText(double probability) {
  if (std::isnan(probability)) return "no probability";
  if (probability > 0.99) return "over 99 %";
  if (!(probability >= 0.01)) return "under 1 %";
  return fmt::format("{:.0f} %", std::floor(100.0 * probability + 1e-9));
}

VerdictLevel LevelFor(double probability, bool objected) {
  if (!(probability >= Verdict::kLikely)) return VerdictLevel::kUnsure;
  return probability >= Verdict::kConfirmed && !objected ? VerdictLevel::kConfirmed
                                                         : VerdictLevel::kLikely;
}

const char* MarginWords(double nats) {
  if (std::isnan(nats)) return "not comparable";
  if (nats < 0.0) return "more likely";
  if (nats < kComparable_nats) return "about as likely";
  if (nats < 10.0) return "a little less likely";
  if (nats < 50.0) return "clearly less likely";
  return "far less likely";
}

}  // namespace foresight
