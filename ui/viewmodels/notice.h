#pragma once

#include <QMetaType>
#include <QString>

#include "core/base/result.h"

namespace foresight {

/// Something the operator should know: what happened, and what to do next. Shown in a strip, never
/// in a dialog.
struct Notice {
  enum class Level { kInfo, kWarning, kError };
  Level level = Level::kInfo;
  QString what;
  QString next;
  /// What it is about, where a later event can end that ("scan", "recording"); may be empty.
  QString topic = {};
  /// Id of the command that does what `next` says (CommandTable); may be empty.
  QString command = {};

  bool operator==(const Notice&) const = default;
};

/// Topics: the last scan, the operator's stop and abort, the link to the head, the mission file
/// that is written, the one that the program left behind when it was killed.
inline const QString kScanTopic = QStringLiteral("scan");
inline const QString kStopTopic = QStringLiteral("stop");
inline const QString kAbortTopic = QStringLiteral("abort");
inline const QString kLinkTopic = QStringLiteral("link");
inline const QString kRecordingTopic = QStringLiteral("recording");
inline const QString kInterruptedTopic = QStringLiteral("interrupted");

/// Topic: the decision on this object.
inline QString DecisionTopic(const std::string& object_uuid) {
  return QStringLiteral("decision ") + QString::fromStdString(object_uuid);
}

/// The notice for a failed step; `doing` starts the sentence, e.g. "Fitting the valve".
Notice NoticeOf(const QString& doing, const Error& error);

}  // namespace foresight

Q_DECLARE_METATYPE(foresight::Notice)
