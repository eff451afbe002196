#include "ui/viewmodels/no_scan_hint.h"

#include <QCoreApplication>
#include <QStringList>

namespace foresight {
namespace {

QString HintText(const char* text, int n = -1) {
  return QCoreApplication::translate("NoScanHint", text, nullptr, n);
}

QString Counted(int count, const char* one, const char* many) {
  return count == 1 ? HintText(one) : HintText(many).arg(count);
}

}  // namespace

QString NoScanHint(const SessionModel& session) {
  if (session.Mode() == SessionMode::kReplay)
    return HintText("Open a mission for review (Ctrl+O), or choose one of its scans");
  const EarlierContents& earlier = session.Earlier();
  if (earlier.scans == 0) return HintText("No scan yet: press Scan (Space)");
  QString hint = earlier.scans == 1
                     ? HintText(
                           "No scan since the program began: press Scan (Space). The one that this "
                           "mission holds is in the list of scans")
                     : HintText(
                           "No scan since the program began: press Scan (Space). The %n that this "
                           "mission holds are in the list of scans",
                           earlier.scans);
  const QString interrupted = InterruptedText(earlier);
  return interrupted.isEmpty() ? hint : hint + QStringLiteral(". ") + interrupted;
}

QString EarlierText(const EarlierContents& earlier) {
  QStringList parts;
  if (earlier.scans > 0) parts << Counted(earlier.scans, "1 scan", "%1 scans");
  if (earlier.objects > 0) parts << Counted(earlier.objects, "1 object", "%1 objects");
  if (earlier.notes > 0) parts << Counted(earlier.notes, "1 note", "%1 notes");
  if (parts.size() < 2) return parts.join(QString());
  const QString last = parts.takeLast();
  return HintText("%1 and %2").arg(parts.join(QStringLiteral(", ")), last);
}

QString InterruptedText(const EarlierContents& earlier) {
  if (!earlier.interrupted.isValid()) return {};
  return HintText("The scan of %1 was interrupted.")
      .arg(earlier.interrupted.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")));
}

QString EarlierObjectsHint(const SessionModel& session) {
  const int objects = session.Earlier().objects;
  if (session.Mode() == SessionMode::kReplay || objects == 0) return {};
  return Counted(
      objects,
      "The mission holds 1 object from before the restart: choose its scan in the list of "
      "scans.",
      "The mission holds %1 objects from before the restart: choose their scans in the list of "
      "scans.");
}

QString EarlierNotesHint(const SessionModel& session) {
  const int notes = session.Earlier().notes;
  if (session.Mode() == SessionMode::kReplay || notes == 0) return {};
  return Counted(
      notes,
      "The mission holds 1 note from before the restart: choose a scan in the list of scans.",
      "The mission holds %1 notes from before the restart: choose a scan in the list of scans.");
}

}  // namespace foresight
