#pragma once

#include <QObject>
#include <QString>

#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Writes what is on the screen for other programs.
class ExportViewModel : public QObject {
  Q_OBJECT

 public:
  explicit ExportViewModel(SessionModel* session, QObject* parent = nullptr);

  TaskRunner* Runner() { return &runner_; }
  bool CanExport() const { return session_->CurrentScan() && session_->Cloud(); }
  /// The lidar's points in the robot's frame, metres, as binary PLY.
  void ExportCloud(const QString& path);

 private:
  SessionModel* session_;
  TaskRunner runner_{session_->Tasks()};
};

}  // namespace foresight
