#pragma once

#include <QWidget>
#include <vector>

#include "core/mission/mission_records.h"

class QIcon;
class QListWidget;

namespace foresight {

/// Time, scope, speed, state and number of objects of a scan, in three lines.
QString TextFor(const ScanSummary& scan);
/// Its thumbnail, or an empty one.
QIcon IconFor(const ScanSummary& scan);

/// The scans of a mission: thumbnail, time, scope, speed, state, number of objects.
class ScanList : public QWidget {
  Q_OBJECT

 public:
  explicit ScanList(QWidget* parent = nullptr);

  void Show(const std::vector<ScanSummary>& scans, int chosen);
  int Count() const;
  QString TextOf(int row) const;

 Q_SIGNALS:
  /// The operator wants to see this scan.
  void chosen(int index);

 private:
  QListWidget* list_;
  std::vector<ScanSummary> scans_;
};

}  // namespace foresight
