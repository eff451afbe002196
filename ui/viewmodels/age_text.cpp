#include "ui/viewmodels/age_text.h"

#include <QObject>

namespace foresight {

QString AgeText(std::chrono::seconds age) {
  const auto seconds = static_cast<qint64>(age.count());
  if (seconds < 10) return QObject::tr("under 10 s");
  if (seconds < 60) return QObject::tr("%1 s").arg(seconds / 10 * 10);
  if (seconds < 3600) return QObject::tr("%1 min").arg(seconds / 60);
  if (seconds < 48 * 3600)
    return QObject::tr("%1 h %2 min").arg(seconds / 3600).arg(seconds / 60 % 60);
  return QObject::tr("%1 days").arg(seconds / (24 * 3600));
}

}  // namespace foresight
