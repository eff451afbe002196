#pragma once

#include <QWidget>
#include <vector>

#include "core/mission/mission_records.h"

class QListWidget;

namespace foresight {

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
