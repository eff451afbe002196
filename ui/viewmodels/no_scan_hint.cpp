#include "ui/viewmodels/no_scan_hint.h"

#include <QCoreApplication>

namespace foresight {

QString NoScanHint(const SessionModel& session) {
  const auto tr = [](const char* text, int n = -1) {
    return QCoreApplication::translate("NoScanHint", text, nullptr, n);
  };
  const int earlier = session.EarlierScans();
  if (earlier == 0) return tr("No scan yet: press Scan (Space)");
  if (earlier == 1)
    return tr(
        "No scan since the program began: press Scan (Space). The one that this mission holds is "
        "in "
        "the list of scans");
  return tr(
      "No scan since the program began: press Scan (Space). The %n that this mission holds are in "
      "the "
      "list of scans",
      earlier);
}

}  // namespace foresight
