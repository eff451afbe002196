#include "ui/viewmodels/advice.h"

#include <QCoreApplication>

#include "core/detection/candidates.h"
#include "core/detection/facts.h"

namespace foresight {
namespace {

/// Texts that lupdate finds under this name.
struct AdviceTexts {
  Q_DECLARE_TR_FUNCTIONS(AdviceTexts)
};

QString LevelName(VerdictLevel level) {
  return QString::fromUtf8(ToString(level));
}

/// The verdict that is about the candidate itself: a terrain has one for each surface.
const Verdict* OwnVerdict(const Detection& detection, int candidate) {
  if (const auto* terrain = std::get_if<TerrainDetection>(&detection)) {
    const auto index = static_cast<std::size_t>(std::max(0, candidate));
    return index < terrain->surfaces.size() ? &terrain->surfaces[index].verdict : nullptr;
  }
  return candidate <= 0 ? &VerdictOf(detection) : nullptr;
}

/// As OwnVerdict; of a terrain in which no surface was found, why that is.
const Verdict* StatedVerdict(const Detection& detection, int candidate) {
  const Verdict* own = OwnVerdict(detection, candidate);
  return own == nullptr && candidate == 0 ? &VerdictOf(detection) : own;
}

QString WhyNotToActOn(bool is_current, SessionMode mode, Decision decision) {
  if (mode == SessionMode::kReplay)
    return AdviceTexts::tr("Review: do not act on it. The scene may have changed since.");
  if (decision == Decision::kRejected) return AdviceTexts::tr("You rejected it: do not act on it.");
  if (!is_current) return AdviceTexts::tr("From an earlier scan: fit it again in the newest one.");
  return {};
}

/// "accepted", "accepted: alternative 1", "rejected: surface 2".
QString DecisionText(const FoundObject& object) {
  const QString word = object.decision == Decision::kAccepted ? AdviceTexts::tr("accepted")
                                                              : AdviceTexts::tr("rejected");
  const int candidate = object.decided_candidate;
  if (candidate == 0) return word;
  return std::holds_alternative<TerrainDetection>(object.detection)
             ? AdviceTexts::tr("%1: surface %2").arg(word).arg(candidate + 1)
             : AdviceTexts::tr("%1: alternative %2").arg(word).arg(candidate);
}

QString ByLevel(VerdictLevel level, bool has_alternatives, SessionMode mode) {
  switch (level) {
    case VerdictLevel::kConfirmed:
      return mode == SessionMode::kSimulation
                 ? AdviceTexts::tr(
                       "Good to act on, in this simulation. Compare the outline with the image.")
                 : AdviceTexts::tr("Good to act on. Compare the outline with the image.");
    case VerdictLevel::kLikely:
      return has_alternatives
                 ? AdviceTexts::tr(
                       "Compare the outline with the image and step through the alternatives "
                       "before acting.")
                 : AdviceTexts::tr("Compare the outline with the image before acting.");
    case VerdictLevel::kUnsure:
      break;
  }
  return AdviceTexts::tr(
      "Do not act on this. Draw the region closer, or scan slower or from nearer.");
}

}  // namespace

QString ReasonFor(const Detection& detection, int candidate) {
  const Verdict* own = OwnVerdict(detection, candidate);
  return own != nullptr ? QString::fromStdString(own->reason) : QString();
}

QString StateText(const FoundObject& object, bool is_current) {
  const int candidate = object.decision == Decision::kOpen ? 0 : object.decided_candidate;
  const Verdict* own = StatedVerdict(object.detection, candidate);
  const bool doubtful = object.decision == Decision::kAccepted &&
                        CandidateLevel(object.detection, candidate) == VerdictLevel::kUnsure;
  QStringList parts;
  if (object.decision != Decision::kOpen) parts << DecisionText(object);
  if (doubtful)
    parts << AdviceTexts::tr("although UNSURE");
  else if (own != nullptr)
    parts << LevelName(own->level);
  if (!is_current) parts << AdviceTexts::tr("earlier scan");
  return parts.join(QStringLiteral(", "));
}

Advice AdviceFor(const FoundObject& object, int candidate, bool is_current, SessionMode mode) {
  Advice advice;
  const Verdict* own = OwnVerdict(object.detection, candidate);
  if (own != nullptr) {
    advice.level = own->level;
    advice.badge = QStringLiteral("%1, %2").arg(
        LevelName(own->level), QString::fromStdString(ProbabilityText(own->probability)));
  } else {
    advice.level = CandidateLevel(object.detection, candidate);
    advice.badge = AdviceTexts::tr("ALTERNATIVE");
  }
  advice.text = WhyNotToActOn(is_current, mode, object.decision);
  if (!advice.text.isEmpty()) return advice;
  advice.text =
      own != nullptr ? ByLevel(own->level, CandidateCount(object.detection) > 1, mode)
      : advice.level == VerdictLevel::kLikely
          ? AdviceTexts::tr(
                "About as likely as the best answer: compare both outlines with the image.")
          : AdviceTexts::tr(
                "Do not act on this alternative: the best answer explains the measurements "
                "better.");
  if (object.part)
    advice.text +=
        AdviceTexts::tr(" Made from part of the scan: fit again when all of it is here.");
  return advice;
}

}  // namespace foresight
