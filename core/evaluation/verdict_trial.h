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

/// Among answers whose number lies from `from` up to `to`: those that are right in every respect,
/// those that took another thing for the object, and the log of the ratio of both as fractions of
/// all such answers, each bin with one more of both.
struct OddsBin {
  double from = 0.0;
  double to = 0.0;
  int right = 0;
  int wrong = 0;
  double nats = 0.0;
};
/// What a number, a feature or evidence, says for an answer: what constants that turn it into nats
/// are made of. Answers with a failed gate do not count; what lies beyond the first or the last bin
/// counts there. Fails as AddTrialGate does, and for answers of the other world.
Result<std::vector<OddsBin>> OddsOf(const std::string& name, double from, double to, int bins,
                                    const std::vector<std::string>& features,
                                    const std::vector<FitOutcome>& outcomes);

}  // namespace foresight
