#pragma once

#include <QString>

#include "ui/viewmodels/session_model.h"

namespace foresight {

/// What an operator may make of the answer on the screen: it depends on the verdict, and on whether
/// that answer is the best one, of the newest scan, live, and decided on.
struct Advice {
  VerdictLevel level = VerdictLevel::kUnsure;  ///< of the answer that is drawn
  /// "CONFIRMED, over 99 %"; without a probability where the answer is an alternative: the
  /// probability is the best answer's.
  QString badge;
  QString text;  ///< one or two sentences: what to do
};

/// Why the verdict on the answer that is drawn is what it is; empty for an alternative.
QString ReasonFor(const Detection& detection, int candidate);

/// What the list says of it: "accepted, CONFIRMED", "accepted: alternative 1", "accepted, although
/// UNSURE", "LIKELY, earlier scan". A verdict is about the best answer alone.
QString StateText(const FoundObject& object, bool is_current);

Advice AdviceFor(const FoundObject& object, int candidate, bool is_current, SessionMode mode);

}  // namespace foresight
