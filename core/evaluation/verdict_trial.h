#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/fit_trial.h"

namespace foresight {

// What the evidence and the gates of a verdict are chosen by: judged answers, looked at as if the
// program had other features or other gates. Nothing here changes a program.

/// A limit that an answer has to keep: "rim_nats>=10", "log_chance_off<=-3".
struct TrialGate {
  std::string name;  ///< a feature of the object's verdict, or FitOutcome::evidence
  bool at_least = true;
  double limit = 0.0;
};
/// Fails with kInvalidOptions where it is no NAME>=NUMBER or NAME<=NUMBER.
Result<TrialGate> TrialGateFrom(std::string_view text);

/// Adds a failed gate to each answer that is found and does not keep the limit; NaN does not.
/// `features` are the names of Verdict::features. Fails with kInvalidOptions for a name that no
/// answer has, saying which there are.
Status AddTrialGate(const TrialGate& gate, const std::vector<std::string>& features,
                    std::vector<FitOutcome>& outcomes);

/// Puts the numbers of these names, features or evidence, in the place of each answer's
/// Verdict::features. "compressed:rim_nats" is sign and log(1 + |value|) (compressed_nats.h).
/// Fails as AddTrialGate does.
Status ReplaceFeatures(const std::vector<std::string>& wanted,
                       const std::vector<std::string>& features, std::vector<FitOutcome>& outcomes);

}  // namespace foresight
