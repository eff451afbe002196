#pragma once

#include <QDateTime>
#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <deque>

#include "ui/viewmodels/notice.h"

namespace foresight {

/// Something that the operator was told.
struct LogEntry {
  quint64 id = 0;
  QDateTime time;
  Notice notice;
  int count = 1;              ///< how often it was said in a row
  bool acknowledged = false;  ///< by the operator, or by itself where it no longer holds
};

/// All that the operator was told, newest last. Information goes away by itself; a warning or an
/// error stays on top until the operator acknowledges it or until what it was about is over.
/// Something weighty is never pushed aside by something light.
class LogModel : public QObject {
  Q_OBJECT

 public:
  explicit LogModel(QObject* parent = nullptr);

  const std::deque<LogEntry>& Entries() const { return entries_; }
  /// What stands on top: the weightiest that is not acknowledged, the newest of those; what became
  /// of the operator's STOP weighs more than any error. nullptr = nothing.
  const LogEntry* Top() const;
  /// How many warnings and errors are not acknowledged.
  int Open() const;

 public Q_SLOTS:
  void add(const foresight::Notice& notice);
  void acknowledge(quint64 id);
  void acknowledgeAll();
  /// What notices of this topic spoke of is over.
  void close(const QString& topic);

 Q_SIGNALS:
  void added(const foresight::Notice& notice);
  void changed();

 private:
  void ExpireInformation();

  std::deque<LogEntry> entries_;
  quint64 last_id_ = 0;
  QTimer expiry_;
};

}  // namespace foresight
